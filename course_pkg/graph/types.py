"""The classes that rospy needs, from whatever a caller gave: a class, a type of `interfaces`, or a name."""

from __future__ import annotations

from typing import Any

import genpy

from course_pkg.errors import NotAMessageType, NotAServiceType


def service_class(kind: Any) -> Any:  # noqa: ANN401 -- generated classes have no common base
    """Return the service class for a class, a ServiceType or a name such as "std_srvs/Trigger"."""
    if isinstance(kind, str):
        from course_pkg.interfaces import service_type

        kind = service_type(kind)
    cls = getattr(kind, "cls", kind)
    if not hasattr(cls, "_request_class"):
        raise NotAServiceType(_wrong_service(cls))
    return cls


def message_class(kind: Any) -> Any:  # noqa: ANN401
    """Return the message class for a class, a MessageType or a name such as "std_msgs/UInt32"."""
    if isinstance(kind, str):
        from course_pkg.interfaces import message_type

        kind = message_type(kind)
    cls = getattr(kind, "cls", kind)
    if not (isinstance(cls, type) and issubclass(cls, genpy.Message)):
        raise NotAMessageType(f"{_name(cls)} is not a message type. Give a class like std_msgs.msg.UInt32.")
    return cls


def _wrong_service(cls: Any) -> str:  # noqa: ANN401
    name = _name(cls)
    for half in ("Request", "Response"):
        if name.endswith(half) and hasattr(cls, "_type"):
            whole = name.removesuffix(half)
            return f"{name} is the {half.lower()} of a service type. Give the type itself: {whole}."
    if isinstance(cls, genpy.Message) or hasattr(cls, "_slot_types"):
        return f"{name} is a message type, for topics. A service needs one like std_srvs.srv.Trigger."
    return f"{name} is not a service type. Give a class like std_srvs.srv.Trigger, from a package's srv."


def _name(cls: Any) -> str:  # noqa: ANN401
    return cls.__name__ if isinstance(cls, type) else f"{cls!r} ({type(cls).__name__})"
