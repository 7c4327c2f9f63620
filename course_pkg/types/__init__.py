"""The fields, values, strings and commands of any service or message type.

This package needs no master and no rospy.

Each name is imported when it is first used.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.types.commands import publisher_lines, rospy_line, rosservice_line, rostopic_line
    from course_pkg.types.fields import Constant, Field, Kind, MessageClass, Plain, ServiceClass, StringTree
    from course_pkg.types.form_schema import FieldSchema, MessageSchema, ServiceSchema, schema
    from course_pkg.types.search_path import (
        DefinitionKind,
        definition_file,
        list_message_types,
        list_service_types,
        read_definition,
    )
    from course_pkg.types.types import (
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
    "DefinitionKind",
    "Field",
    "FieldSchema",
    "Kind",
    "MessageClass",
    "MessageSchema",
    "MessageType",
    "Plain",
    "ServiceClass",
    "ServiceSchema",
    "ServiceType",
    "StringTree",
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

__getattr__ = lazily(
    __name__,
    {
        "commands": "publisher_lines rospy_line rosservice_line rostopic_line",
        "fields": "Constant Field Kind MessageClass Plain ServiceClass StringTree",
        "form_schema": "FieldSchema MessageSchema ServiceSchema schema",
        "search_path": (
            "DefinitionKind definition_file list_message_types list_service_types read_definition"
        ),
        "types": (
            "MessageType ServiceType compile_message compile_service message_type service_type type_in_file"
        ),
    },
)
