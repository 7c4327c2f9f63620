"""Service and message types: their fields, and the conversion between dicts and messages."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import genpy
from genmsg.msg_loader import MsgContext, load_msg_from_string
from genmsg.msgs import parse_type

from course_pkg.errors import UnknownType
from course_pkg.types.compile import compiled_message, compiled_service, dependency
from course_pkg.types.definition import comments
from course_pkg.types.fields import (
    Constant,
    Field,
    Kind,
    MessageClass,
    Plain,
    ServiceClass,
    StringTree,
    builtin_field,
)
from course_pkg.types.search_path import (
    DefinitionKind,
    built_message,
    built_service,
    definition_file,
    read_definition,
    unknown_type,
)
from course_pkg.types.strings import format_value, parse_fields
from course_pkg.types.values import build, check_fields, default

_END_OF_OWN_TEXT = "\n" + "=" * 80 + "\n"


@dataclass(frozen=True)
class MessageType:
    """A message type, or the request or response of a service type.

    A value of the type is a dict with the field names as keys. `cls` is the class that genpy generated, and
    `help` is the comment at the top of the definition.
    """

    name: str
    md5: str
    text: str = field(repr=False)
    fields: tuple[Field, ...] = field(repr=False)
    constants: tuple[Constant, ...] = field(repr=False)
    cls: MessageClass = field(repr=False, compare=False)
    help: str = field(default="", repr=False, compare=False)

    def default(self) -> dict[str, Plain]:
        """Return the default values of all fields."""
        return {each.name: default(each) for each in self.fields}

    def check(self, plain: Mapping[str, Plain] | genpy.Message) -> dict[str, Plain]:
        """Check a message or a dict of values, and return the values of its fields as a dict.

        Raises FieldError if a value is not valid for its field.
        """
        return check_fields(self.fields, plain, "", self._shape)

    def parse(self, tree: StringTree) -> dict[str, Plain]:
        """Convert a string tree into a dict of values.

        Raises FieldError if a string is not valid for its field.
        """
        return parse_fields(self.fields, tree, "", self._shape)

    def format(self, plain: Mapping[str, Plain]) -> dict[str, StringTree]:
        """Convert a dict of values into a string tree, which `parse` can read."""
        return {each.name: format_value(each, plain[each.name]) for each in self.fields}

    def to_message(self, plain: Mapping[str, Plain]) -> genpy.Message:
        """Return a message with these values.

        Raises FieldError if a value is not valid for its field.
        """
        return build(self.cls, self.fields, self.check(plain))

    def to_values(self, message: genpy.Message) -> dict[str, Plain]:
        """Return the values of a message.

        A float32 becomes the shortest number with the same value.

        Raises FieldError if the message contains a value that does not fit its field.
        """
        return self.check(message)

    @property
    def built(self) -> bool:
        """Whether Python can import the class from its package.

        If `built` is False, the class was generated from the definition.
        """
        return not hasattr(self.cls, "_dependencies")

    @property
    def _shape(self) -> str:
        names = ", ".join(each.name for each in self.fields)
        return f"the fields {names}" if names else "no fields"


@dataclass(frozen=True)
class ServiceType:
    """A service type; `cls` is the class for rospy's Service and ServiceProxy.

    `built` is True if Python can import the class from its package. If `built` is False, the class was
    generated from the definition.
    """

    name: str
    md5: str
    text: str = field(repr=False)
    request: MessageType = field(repr=False)
    response: MessageType = field(repr=False)
    cls: ServiceClass = field(repr=False, compare=False)
    built: bool = field(compare=False)


def service_type(type_or_name: str | ServiceType | ServiceClass) -> ServiceType:
    """Return the service type for a full name (`std_srvs/SetBool`) or for a generated class.

    If a type on ROS_PACKAGE_PATH is not built, the class of the type is generated from the definition. Raises
    UnknownType if there is no such type, and BrokenDefinition if ROS does not accept its definition.
    """
    if isinstance(type_or_name, ServiceType):
        return type_or_name
    if not isinstance(type_or_name, str):
        _require_class(type_or_name, "_request_class", "a service")
        return _service(type_or_name)
    if cls := built_service(type_or_name):
        return _service(cls)
    if file := definition_file(type_or_name, "srv"):
        return _service(compiled_service(type_or_name, read_definition(file), str(file)))
    raise unknown_type(type_or_name, "srv")


def message_type(type_or_name: str | MessageType | MessageClass) -> MessageType:
    """Return the message type for a full name (`geometry_msgs/Point`) or for a generated class.

    If a type is not built, its class is generated; the errors are the same as in service_type().
    """
    if isinstance(type_or_name, MessageType):
        return type_or_name
    if not isinstance(type_or_name, str):
        _require_class(type_or_name, "_slot_types", "a message")
        return _message(type_or_name)
    name = "std_msgs/Header" if type_or_name == "Header" else type_or_name
    if cls := built_message(name):
        return _message(cls)
    if file := definition_file(name, "msg"):
        return _message(compiled_message(name, read_definition(file), str(file)))
    raise unknown_type(name, "msg")


def type_in_file(name: str, kind: DefinitionKind) -> ServiceType | MessageType:
    """Return the type that a .srv or .msg file defines now, even if an older version is built.

    Raises UnknownType if there is no such type, and BrokenDefinition if ROS does not accept its definition.
    """
    file = definition_file(name, kind)
    if file is None:
        raise unknown_type(name, kind)
    text = read_definition(file)
    if kind == "srv":
        return _service(compiled_service(name, text, str(file)))
    return _message(compiled_message(name, text, str(file)))


def compile_service(name: str, text: str) -> ServiceType:
    """Return the service type `name`; `text` is the text of its .srv file.

    This function is stricter than genmsg, which accepts some mistakes (no `---` line, two `---` lines, a name
    that is a keyword of Python). Raises BrokenDefinition if the text has a mistake.
    """
    return _service(compiled_service(name, text, f"{name}.srv", strict=True))


def compile_message(name: str, text: str) -> MessageType:
    """Return the message type `name`; `text` is the text of its .msg file.

    This function refuses the same mistakes as compile_service(), and raises the same errors.
    """
    return _message(compiled_message(name, text, f"{name}.msg", strict=True))


def _require_class(cls: MessageClass | ServiceClass, attribute: str, what: str) -> None:
    """Raise UnknownType if `cls` is not a generated class of the expected kind."""
    if hasattr(cls, attribute):
        return
    shown = getattr(cls, "__name__", repr(cls))
    if getattr(cls, "_type", "").endswith(("Request", "Response")):
        service = cls._type.rpartition("/")[2].removesuffix("Request").removesuffix("Response")
        raise UnknownType(shown, f"{shown} is one half of a service type; pass the whole type, {service}")
    raise UnknownType(shown, f"{shown} is not {what} type; pass its class, or its full name as package/Type")


def _service(cls: ServiceClass) -> ServiceType:
    request, response = _message(cls._request_class), _message(cls._response_class)
    # genmsg adds a newline after the request and after the response.
    text = f"{request.text}---\n{response.text.removesuffix(chr(10))}"
    return ServiceType(
        cls._type, cls._md5sum, text, request, response, cls, not hasattr(cls, "_dependencies")
    )


def _message(cls: MessageClass) -> MessageType:
    text = cls._full_text.split(_END_OF_OWN_TEXT)[0]
    found = comments(text)
    fields = tuple(
        _field(cls, name, type_name, found.fields.get(name) or found.fields.get(name.removesuffix("_"), ""))
        for name, type_name in zip(cls.__slots__, cls._slot_types, strict=True)
    )
    return MessageType(cls._type, cls._md5sum, text, fields, _constants(cls._type, text), cls, found.whole)


def _field(cls: MessageClass, name: str, type_name: str, help_text: str = "") -> Field:
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
