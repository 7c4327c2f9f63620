"""Plain values as arguments for the tools of ROS, which read them as YAML."""

from __future__ import annotations

import math
from collections.abc import Mapping

import yaml

from course_pkg.interfaces.fields import Field, Kind, Value


def arguments(fields: tuple[Field, ...], values: Mapping[str, Value]) -> list[str]:
    """Return one argument for each scalar, or, as soon as a field is none, one YAML dict of them all."""
    if all(field.kind.is_scalar for field in fields):
        return [_yaml(field, values[field.name]) for field in fields]
    return [_yaml_dict(fields, values)]


def options_end(given: list[str]) -> list[str]:
    """Return the -- behind which an option parser takes -1.0 for what it is, where that is needed."""
    return ["--"] if any(each.startswith("-") for each in given) else []


def _yaml(field: Field, value: Value) -> str:
    if field.kind is Kind.ARRAY:
        assert field.item is not None
        return f"[{', '.join(_yaml(field.item, each) for each in value)}]"
    if field.kind is Kind.MESSAGE or field.fields:
        return _yaml_dict(field.fields, value)
    if field.kind is Kind.FLOAT:
        return _yaml_float(value)
    if field.kind is Kind.BOOL:
        return "true" if value else "false"
    return _yaml_text(value) if field.kind is Kind.STRING else str(value)


def _yaml_dict(fields: tuple[Field, ...], values: Mapping[str, Value]) -> str:
    return f"{{{', '.join(f'{_yaml_text(each.name)}: {_yaml(each, values[each.name])}' for each in fields)}}}"


def _yaml_float(number: float) -> str:
    if math.isnan(number):
        return ".nan"
    text = repr(number).replace("inf", ".inf")
    # YAML 1.1 takes 1e+20 for a string and 1.0e+20 for a number.
    return text.replace("e", ".0e") if "e" in text and "." not in text else text


def _yaml_text(text: str) -> str:
    """Return a string so that YAML reads it as that string, whatever it looks like."""
    if text.isprintable() and ":=" not in text and _is_plain(text):
        return text
    quoted: str = yaml.safe_dump(text, default_style='"', allow_unicode=True, width=math.inf)
    # The tools of ROS take an argument with := for a remapping and drop it.
    return quoted.rstrip("\n").replace(":=", r":\x3D")


def _is_plain(text: str) -> bool:
    try:
        return bool(
            yaml.safe_load(text) == text
            and yaml.safe_load(f"[{text}, {{{text}: {text}}}]") == [text, {text: text}]
        )
    except (yaml.YAMLError, ValueError):
        # A ValueError for what looks like a date, and is none.
        return False
