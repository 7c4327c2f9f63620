"""Any service or message type as plain values: its fields, texts, commands. Knows no master and no rospy."""

from course_pkg.interfaces.commands import publisher_lines, rospy_line, rosservice_line, rostopic_line
from course_pkg.interfaces.fields import Constant, Field, Kind
from course_pkg.interfaces.path import list_message_types, list_service_types
from course_pkg.interfaces.schema import schema
from course_pkg.interfaces.types import (
    MessageType,
    ServiceType,
    compile_message,
    compile_service,
    message_type,
    service_type,
)

__all__ = [
    "Constant",
    "Field",
    "Kind",
    "MessageType",
    "ServiceType",
    "compile_message",
    "compile_service",
    "list_message_types",
    "list_service_types",
    "message_type",
    "publisher_lines",
    "rospy_line",
    "rosservice_line",
    "rostopic_line",
    "schema",
    "service_type",
]
