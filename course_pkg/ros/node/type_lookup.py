"""Find the generated class of a message or service type."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias, TypeGuard, Union

import genpy

from course_pkg.errors import NotAMessageType, NotAServiceType

if TYPE_CHECKING:
    from course_pkg.types import MessageClass, MessageType, ServiceClass, ServiceType

# An instance of a generated class; generated classes have no type annotations.
Message: TypeAlias = Any
ServiceKind = Union[type, "ServiceClass", "ServiceType", str]
MessageKind = Union[type, "MessageClass", "MessageType", str]


def service_class(kind: ServiceKind) -> ServiceClass:
    """Return the generated class for a service class, a ServiceType or a name such as "std_srvs/Trigger".

    Raises UnknownType for an unknown name, and NotAServiceType for an object that is not a service type.
    """
    if isinstance(kind, str):
        from course_pkg.types import service_type

        kind = service_type(kind)
    cls = getattr(kind, "cls", kind)
    if not _is_service(cls):
        raise NotAServiceType(_not_a_service(cls))
    return cls


def message_class(kind: MessageKind) -> MessageClass:
    """Return the generated class for a message class, a MessageType or a name such as "std_msgs/UInt32".

    Raises UnknownType for an unknown name, and NotAMessageType for an object that is not a message type.
    """
    if isinstance(kind, str):
        from course_pkg.types import message_type

        kind = message_type(kind)
    cls = getattr(kind, "cls", kind)
    if not _is_message(cls):
        raise NotAMessageType(
            f"{_name(cls)} is not a message type. Pass a class such as std_msgs.msg.UInt32."
        )
    return cls


def _is_service(cls: object) -> TypeGuard[ServiceClass]:
    return hasattr(cls, "_request_class")


def _is_message(cls: object) -> TypeGuard[MessageClass]:
    return isinstance(cls, type) and issubclass(cls, genpy.Message)


def _not_a_service(cls: object) -> str:
    name = _name(cls)
    for half in ("Request", "Response"):
        if name.endswith(half) and hasattr(cls, "_type"):
            whole = name.removesuffix(half)
            return f"{name} is the {half.lower()} of a service type. Pass the type itself: {whole}."
    if isinstance(cls, genpy.Message) or hasattr(cls, "_slot_types"):
        return f"{name} is a message type, for topics. Pass a service type, such as std_srvs.srv.Trigger."
    return f"{name} is not a service type. Pass a class such as std_srvs.srv.Trigger."


def _name(cls: object) -> str:
    return cls.__name__ if isinstance(cls, type) else f"{cls!r} ({type(cls).__name__})"
