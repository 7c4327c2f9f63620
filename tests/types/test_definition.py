"""Tests of the parser for definitions."""

from __future__ import annotations

import pytest

from course_pkg.errors import BrokenDefinition, UnknownType
from course_pkg.types import compile_message, compile_service, service_type


def refused(text: str) -> BrokenDefinition:
    """Return the error that the parser raises for the text of a .srv file."""
    with pytest.raises(BrokenDefinition) as caught:
        compile_service("course_pkg/Broken", text)
    return caught.value


@pytest.mark.parametrize(
    ("text", "line", "column", "remedy"),
    [
        ("float32 x\n- - -\n", 2, 1, "write ---"),
        ("float32 x\n --- \n", 2, 2, "write ---"),
        ("float32 x\n--\n", 2, 1, "write ---"),
        ("float32 x\n\N{EM DASH}\n", 2, 1, "write ---"),
        ("float32 x\n---float32 y\n", 2, 4, "write --- alone"),
        ("float32 x\nfloat32 y", 2, 1, "add a line of three dashes"),
        ("", 1, 1, "add a line of three dashes"),
        ("---\n---\n", 2, 1, "remove it"),
        ("# side\nflaot32 x\n---\n", 2, 1, "write float32"),
        ("Int32 x\n---\n", 1, 1, "write int32"),
        ("int x\n---\n", 1, 1, "write int32"),
        ("double[3] x\n---\n", 1, 1, "write float64[3]"),
        ("boolean x\n---\n", 1, 1, "write bool"),
        ("x float32\n---\n", 1, 1, "write the type first: float32 x"),
        ("x: float32\n---\n", 1, 1, "write the type first"),
        ("Point x\n---\n", 1, 1, "write geometry_msgs/Point"),
        ("Poimt x\n---\n", 1, 1, "write geometry_msgs/Point"),
        ("Header[] x\n---\n", 1, 1, "write std_msgs/Header[]"),
        ("geometry_msgs/Poimt x\n---\n", 1, 1, "write geometry_msgs/Point"),
        ("nowhere_msgs/Thing x\n---\n", 1, 1, "build and source the package nowhere_msgs"),
        ("float32[][] x\n---\n", 1, 1, "one pair of brackets"),
        ("float32[n] x\n---\n", 1, 1, "length in brackets"),
        ("  float32\n---\n", 1, 10, "write float32 and a name"),
        ("float32 [] x\n---\n", 1, 12, "write float32[] x"),
        ("int32 x 5\n---\n", 1, 9, "int32 X=5"),
        ("// sides\n---\n", 1, 1, "write #"),
        ("unsigned int x\n---\n", 1, 14, "write uint32 x"),
        ("float32 x, y\n---\n", 1, 12, "one field in each line, without commas"),
        ("float32 side length\n---\n", 1, 14, "write float32 side_length"),
        ("float32\tx\n---\n", 1, 8, "write a space"),
        ("float32 x[3]\n---\n", 1, 9, "float32[3] x"),
        ("float32 x;\n---\n", 1, 9, "write x"),
        ("float32 side-length\n---\n", 1, 9, "write side_length"),
        ("float32 1x\n---\n", 1, 9, "begin with a letter"),
        ("float32 größe\n---\n", 1, 9, "begin with a letter"),
        ("float32 lambda\n---\n", 1, 9, "another name"),
        ("float32 serialize\n---\n", 1, 9, "serialize_it"),
        ("float32 x\nint8 x\n---\n", 2, 6, "another name"),
        ("int8 X=1\nint8 X\n---\n", 2, 6, "another name"),
        ("int8 X=300\n---\n", 1, 8, "from -128 to 127"),
        ("int8 X = ten\n---\n", 1, 10, "decimal digits"),
        ("int8 X=\n---\n", 1, 8, "write the value after ="),
        ("int8=3\n---\n", 1, 1, "int32 LIMIT=10"),
        ("bool X=true\n---\n", 1, 8, "True or False"),
        ("float32 X=inf\n---\n", 1, 11, "as in 1.5"),
        ("time X=1\n---\n", 1, 1, "built-in number type"),
        ("geometry_msgs/Point X=1\n---\n", 1, 1, "built-in number type"),
        (" string X=a\n---\n", 1, 1, "first column"),
    ],
)
def test_mistake_has_its_place_and_remedy(text: str, line: int, column: int, remedy: str) -> None:
    """If a definition is invalid, the error message contains the line, the column and a correction."""
    error = refused(text)
    assert (error.line, error.column) == (line, column), error
    assert remedy in error.remedy
    assert error.text == text.split("\n")[line - 1]


def test_the_message_shows_the_line_with_a_mark() -> None:
    """The error message shows the invalid line, with a marker below the mistake."""
    assert str(refused("float32 x\nflaot32 y\n---\n")) == (
        "course_pkg/Broken.srv, line 2, column 1: unknown type 'flaot32'; write float32\n    flaot32 y\n    ^"
    )


@pytest.mark.parametrize(
    "text",
    [
        "---\n",
        "---",
        "\n\n---\n\n",
        "float32 x\r\n---\r\nfloat32 y\r\n",
        "\tfloat32 x\t# indented\n---\n",
        "float32 x# no space\n---\nfloat32 x # the same name in the other half\n",
        "string X= a # b = c\nint8 A=1\nint8 B = 2 # two\n---\n",
        "float32   x\n--- # response\n",
    ],
)
def test_definitions_that_ros_accepts(text: str) -> None:
    """The parser accepts empty requests, Windows line ends, tabs, comments and constants."""
    assert compile_service("course_pkg/Good", text).name == "course_pkg/Good"


def test_a_message_has_no_halves() -> None:
    """The parser refuses a line --- in a message definition."""
    with pytest.raises(BrokenDefinition, match="a message cannot have a --- line"):
        compile_message("course_pkg/Broken", "int8 x\n---\n")


@pytest.mark.parametrize("name", ["Demo", "a/b/c", "/Demo", "course_pkg/"])
def test_a_type_needs_its_package(name: str) -> None:
    """The parser refuses a type name that does not have the form package/Type."""
    with pytest.raises(UnknownType, match="package/Type"):
        compile_service(name, "---\n")


def test_comments_are_kept_with_their_fields() -> None:
    """A field's help text is the comment after the field, or the comment in the line before the field."""
    text = "# A box.\n# All of it.\n\n# in metres\nfloat32 a\nfloat32 b # in feet\nfloat32 c\n"
    request = compile_service("course_pkg/Box", f"{text}---\nbool done # or not\n").request
    assert request.help == "A box. All of it."
    assert [field.help for field in request.fields] == ["in metres", "in feet", ""]
    assert service_type("course_pkg/geometry").request.help == "The three sides of a box, in metres."
    assert service_type("std_srvs/SetBool").request.fields[0].help.startswith("e.g. for hardware")


def test_constants_have_their_values() -> None:
    """Each constant has a type and a value.

    A string constant's value is everything after the equals sign.
    """
    kind = compile_message(
        "course_pkg/Held", "string X= a # b\nint8 LOW=-3 # least\nbool ON=True\nfloat32 pi=3.14\n"
    )
    assert [(each.name, each.value) for each in kind.constants] == [
        ("X", "a # b"),
        ("LOW", -3),
        ("ON", True),
        ("pi", 3.14),
    ]
    assert (kind.cls.X, kind.cls.LOW) == ("a # b", -3)
