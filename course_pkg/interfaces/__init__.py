"""Any service or message type as plain values: its fields, texts, commands. Knows no master and no rospy."""

from course_pkg.interfaces.commands import publisher_lines, rospy_line, rosservice_line, rostopic_line
from course_pkg.interfaces.fields import Constant, Field, Kind
from course_pkg.interfaces.path import (
    Half,
    definition_file,
    list_message_types,
    list_service_types,
    read_definition,
)
from course_pkg.interfaces.schema import schema
from course_pkg.interfaces.types import (
    MessageType,
    ServiceType,
    compile_message,
    compile_service,
    message_type,
    service_type,
    type_in_file,
)

__all__ = [
    "Constant",
    "Field",
    "Half",
    "Kind",
    "MessageType",
    "ServiceType",
    "compile_message",
    "compile_service",
    "definition_file",
    "list_message_types",
    "list_service_types",
    "message_type",
    "publisher_lines",
    "read_definition",
    "rospy_line",
    "rosservice_line",
    "rostopic_line",
    "schema",
    "service_type",
    "type_in_file",
]
