"""The decorator `@remote` declares the methods and attributes that the student's kernel may use."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from types import FunctionType
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., Any])
MARK = "__remote__"


def remote(function: Function) -> Function:
    """Declare that the kernel may call this method, or may read and write the attribute of this property.

    Arguments and results of a remote method are plain values. A result can also be another object with remote
    methods.

        @remote
        def read(self) -> int: ...

        @property
        @remote
        def count(self) -> int: ...
    """
    setattr(function, MARK, True)
    return function


@dataclass(frozen=True)
class Interface:
    """The names that a class has declared with `remote`."""

    methods: frozenset[str]
    readable: frozenset[str]
    writable: frozenset[str]

    def __bool__(self) -> bool:
        return bool(self.methods or self.readable or self.writable)


def interface_of(kind: type) -> Interface:
    """Return the names that the class `kind` has declared with `remote`."""
    members = {name: inspect.getattr_static(kind, name) for name in dir(kind)}
    properties = {name: value for name, value in members.items() if isinstance(value, property)}
    return Interface(
        frozenset(name for name, value in members.items() if _is_remote(value)),
        frozenset(name for name, value in properties.items() if _is_remote(value.fget)),
        frozenset(name for name, value in properties.items() if _is_remote(value.fset)),
    )


def _is_remote(value: object) -> bool:
    return isinstance(value, FunctionType) and hasattr(value, MARK)
