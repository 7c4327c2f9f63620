"""Tests of the JSON description of a form."""

from __future__ import annotations

import json

from course_pkg.types import FieldSchema, MessageSchema, compile_service, schema, service_type

TEXT = """\
# What to move.
int64 count # of steps
geometry_msgs/Point[2] way
time when
uint8 SLOW=1
---
"""


def described() -> tuple[MessageSchema, dict[str, FieldSchema]]:
    """Return the JSON description of a request, and a dict of the descriptions of its fields."""
    request = json.loads(json.dumps(schema(compile_service("course_pkg/Move", TEXT))))["request"]
    return request, {field["name"]: field for field in request["fields"]}


def test_request_and_response_are_described() -> None:
    """The description of a service has a name, an MD5 sum, a request and a response."""
    kind = service_type("course_pkg/geometry")
    whole = schema(kind)
    assert (whole["name"], whole["md5"]) == (kind.name, kind.md5)
    assert [field["name"] for field in whole["response"]["fields"]] == ["area", "volume"]


def test_limits_are_strings() -> None:
    """In the description, the limits of an int64 are strings, because JavaScript rounds large numbers."""
    _, fields = described()
    count = fields["count"]
    assert (count["low"], count["high"]) == (str(-(2**63)), str(2**63 - 1))
    assert (count["kind"], count["help"], count["default"]) == ("integer", "of steps", "0")


def test_nested_fields_are_described() -> None:
    """An array's description has a length and an element type, and a message's description has fields."""
    _, fields = described()
    assert fields["way"]["length"] == 2
    assert [part["name"] for part in fields["way"]["item"]["fields"]] == ["x", "y", "z"]
    assert fields["way"]["default"] == [{"x": "0.0", "y": "0.0", "z": "0.0"}] * 2
    assert [part["high"] for part in fields["when"]["fields"]] == ["4294967295", "999999999"]


def test_help_and_constants_are_described() -> None:
    """The description of a request contains the comment at the top of the definition, and the constants."""
    request, _ = described()
    assert request["help"] == "What to move."
    assert request["constants"] == [{"name": "SLOW", "type": "uint8", "value": "1"}]
