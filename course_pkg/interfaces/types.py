"""Service and message types: what they are made of, and plain values in and out of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import genpy
from genmsg.msg_loader import MsgContext, load_msg_from_string
from genmsg.msgs import parse_type

from course_pkg.errors import UnknownType
from course_pkg.interfaces.compile import compiled_message, compiled_service, dependency
from course_pkg.interfaces.definition import comments
from course_pkg.interfaces.fields import Constant, Field, Kind, TextTree, Value, builtin_field
from course_pkg.interfaces.path import Half, built_class, definition_file, read_definition, unknown
from course_pkg.interfaces.text import read_fields, show
from course_pkg.interfaces.values import build, check_fields, default

_END_OF_OWN_TEXT = "\n" + "=" * 80 + "\n"


@dataclass(frozen=True)
class MessageType:
    """A message type, or one half of a service type.

    Its values are dicts by field name. `cls` is the genpy class, `help` the
    comment at the top of its text.
    """

    name: str
    md5: str
    text: str = field(repr=False)
    fields: tuple[Field, ...] = field(repr=False)
    constants: tuple[Constant, ...] = field(default=(), repr=False)
    cls: Any = field(default=None, repr=False, compare=False)
    help: str = field(default="", repr=False, compare=False)

    def default(self) -> dict[str, Value]:
        """Return the values of a message that nobody filled in."""
        return {each.name: default(each) for each in self.fields}

    def check(self, plain: Mapping[str, Value] | genpy.Message) -> dict[str, Value]:
        """Return plain values as the message holds them, messages within taken apart. Raises FieldError."""
        return check_fields(self.fields, plain, "", self._shape)

    def parse(self, texts: TextTree) -> dict[str, Value]:
        """Return the plain values of a text tree. Raises FieldError."""
        return read_fields(self.fields, texts, "", self._shape)

    def format(self, plain: Mapping[str, Value]) -> dict[str, TextTree]:
        """Return plain values as a text tree; `parse` gives the values back."""
        return {each.name: show(each, plain[each.name]) for each in self.fields}

    def to_message(self, plain: Mapping[str, Value]) -> genpy.Message:
        """Return a message with the plain values in it. Raises FieldError."""
        return build(self.cls, self.fields, self.check(plain))

    def to_values(self, message: genpy.Message) -> dict[str, Value]:
        """Return the plain values of a message; float32 as the shortest number of equal value.

        Raises FieldError where somebody put into the message what its field cannot hold.
        """
        return self.check(message)

    @property
    def built(self) -> bool:
        """Whether Python can import the class from its package; otherwise it was generated from the text."""
        return not hasattr(self.cls, "_dependencies")

    @property
    def _shape(self) -> str:
        names = ", ".join(each.name for each in self.fields)
        return f"the fields {names}" if names else "no fields"


@dataclass(frozen=True)
class ServiceType:
    """A service type; `cls` is the class that rospy takes for Service and ServiceProxy.

    `built` tells whether Python can import the class from its package; where it
    cannot, the class was generated from the text.
    """

    name: str
    md5: str
    text: str = field(repr=False)
    request: MessageType = field(repr=False)
    response: MessageType = field(repr=False)
    cls: Any = field(default=None, repr=False, compare=False)
    built: bool = field(default=True, compare=False)


def service_type(type_or_name: Any) -> ServiceType:  # noqa: ANN401 - a name or a generated class
    """Return the service type of a full name (`std_srvs/SetBool`) or of a generated class.

    A type that is on ROS_PACKAGE_PATH but not built is generated from its text.
    Raises UnknownType, and BrokenDefinition for a text that is not what ROS accepts.
    """
    if isinstance(type_or_name, ServiceType):
        return type_or_name
    if not isinstance(type_or_name, str):
        return _service(_of_class(type_or_name, "_request_class", "a service"))
    if cls := built_class(type_or_name, "srv"):
        return _service(cls)
    if file := definition_file(type_or_name, "srv"):
        return _service(compiled_service(type_or_name, read_definition(file), str(file)))
    raise unknown(type_or_name, "srv")


def message_type(type_or_name: Any) -> MessageType:  # noqa: ANN401 - a name or a generated class
    """Return the message type of a full name (`geometry_msgs/Point`) or of a generated class.

    Otherwise as `service_type`.
    """
    if isinstance(type_or_name, MessageType):
        return type_or_name
    if not isinstance(type_or_name, str):
        return _message(_of_class(type_or_name, "_slot_types", "a message"))
    name = "std_msgs/Header" if type_or_name == "Header" else type_or_name
    if cls := built_class(name, "msg"):
        return _message(cls)
    if file := definition_file(name, "msg"):
        return _message(compiled_message(name, read_definition(file), str(file)))
    raise unknown(name, "msg")


def type_in_file(name: str, half: Half) -> ServiceType | MessageType:
    """Return a type as its .srv or .msg file says it now, whatever was built from it before.

    Raises UnknownType, and BrokenDefinition for a text that is not what ROS accepts.
    """
    file = definition_file(name, half)
    if file is None:
        raise unknown(name, half)
    text = read_definition(file)
    if half == "srv":
        return _service(compiled_service(name, text, str(file)))
    return _message(compiled_message(name, text, str(file)))


def compile_service(name: str, text: str) -> ServiceType:
    """Return the service type that a .srv text would become if it were built as `name`.

    Stricter than genmsg where that lets a slip through in silence (no `---`, two of
    them, a name that Python keeps for itself). Raises BrokenDefinition.
    """
    return _service(compiled_service(name, text, f"{name}.srv", strict=True))


def compile_message(name: str, text: str) -> MessageType:
    """Return the message type that a .msg text would become if it were built as `name`.

    Otherwise as `compile_service`.
    """
    return _message(compiled_message(name, text, f"{name}.msg", strict=True))


def _of_class(cls: Any, attribute: str, what: str) -> Any:  # noqa: ANN401 - a generated class
    if hasattr(cls, attribute):
        return cls
    shown = getattr(cls, "__name__", repr(cls))
    if getattr(cls, "_type", "").endswith(("Request", "Response")):
        service = cls._type.rpartition("/")[2].removesuffix("Request").removesuffix("Response")
        raise UnknownType(shown, f"{shown} is one half of a service type; give the whole, {service}")
    raise UnknownType(shown, f"{shown} is not {what} type; give its class, or its full name as package/Type")


def _service(cls: Any) -> ServiceType:  # noqa: ANN401 - a generated class
    request, response = _message(cls._request_class), _message(cls._response_class)
    # genmsg ends each half with a newline of its own.
    text = f"{request.text}---\n{response.text.removesuffix(chr(10))}"
    return ServiceType(
        cls._type, cls._md5sum, text, request, response, cls, not hasattr(cls, "_dependencies")
    )


def _message(cls: Any) -> MessageType:  # noqa: ANN401 - a generated class
    text = cls._full_text.split(_END_OF_OWN_TEXT)[0]
    said = comments(text)
    fields = tuple(
        _field(cls, name, type_name, said.fields.get(name) or said.fields.get(name.removesuffix("_"), ""))
        for name, type_name in zip(cls.__slots__, cls._slot_types, strict=True)
    )
    return MessageType(cls._type, cls._md5sum, text, fields, _constants(cls._type, text), cls, said.whole)


def _field(cls: type, name: str, type_name: str, help_text: str = "") -> Field:
    base, is_array, length = parse_type(type_name)
    if is_array:
        return Field(name, type_name, Kind.ARRAY, length=length, item=_field(cls, "", base), help=help_text)
    if builtin := builtin_field(name, base, help_text):
        return builtin
    nested = dependency(cls, base)
    parts = _message(nested).fields
    return Field(name, base, Kind.MESSAGE, fields=parts, cls=nested, help=help_text)


def _constants(name: str, text: str) -> tuple[Constant, ...]:
    if "=" not in text:
        return ()
    spec = load_msg_from_string(MsgContext.create_default(), text, name)
    return tuple(Constant(each.name, each.type, each.val) for each in spec.constants)
