"""Find a student's function or class that is older than the code in its cell.

If a function is older than its cell, a check would examine old code, not the code in the cell. One cause is a
syntax error in the changed cell. Another cause is that the student has run the handler's cell again, but not
the cell that creates the service.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
from types import FunctionType, MethodType

from course_pkg.checking.plain_values import Value
from course_pkg.ros.notebook.cells import CellRun

LaterRun = Callable[[str], CellRun | None]


class OlderCode:
    """Finds functions and classes in the kernel that are older than the last run of their cell."""

    def __init__(self, namespace: Mapping[str, Value], later_run: LaterRun) -> None:
        self._namespace = namespace
        self._later_run = later_run

    def of_value(self, name: str, value: Value) -> str:
        """Return an instruction for the student if `value` is older than the code in its cell, or ""."""
        run = self._run_after(value)
        if run is None:
            return ""
        if run.error:
            return f"{name} is {_older(run)}. {_correct()}"
        return (
            f"{name} is {_older(run)}, because this run did not define {name}. Run the cell that "
            f"defines {name}, and then run this cell again."
        )

    def of_service(self, service: str) -> str:
        """Return an instruction for the student if the handler of `service` is older than its cell, or ""."""
        handler = _handler_of(service)
        run = self._run_after(handler)
        if run is None:
            return ""
        name = getattr(_function_of(handler), "__name__", "handler")
        answers = f"The service {service} uses a version of {name} that is {_older(run)}"
        if run.error:
            return f"{answers}. {_correct()}"
        return f"{answers}. Run the cell that creates the service, and then run this cell again."

    def _run_after(self, value: Value) -> CellRun | None:
        """Return the last run of the cell that defined `value`; return None if `value` is not older."""
        for function in _functions_of(value):
            run = self._later_run(function.__code__.co_filename)
            if run is not None and not self._defined_again(function):
                return run
        return None

    def _defined_again(self, function: FunctionType) -> bool:
        """Return whether the last run of the cell defined the function again, with the same code.

        In this case, a change in the cell did not affect this function.
        """
        first, *rest = function.__qualname__.split(".")
        current = self._namespace.get(first)
        for attribute in rest:
            current = getattr(current, attribute, None)
        if not isinstance(current, FunctionType) or current.__code__ is function.__code__:
            return False
        with suppress(OSError, TypeError):
            return inspect.getsource(current) == inspect.getsource(function)
        return False


def _older(run: CellRun) -> str:
    return "older than the last run of its cell" + (f", which ended with {run.error}" if run.error else "")


def _correct() -> str:
    return "Correct and run that cell, and then run this cell again."


def _handler_of(service: str) -> Value:
    """Return this process's handler of the service `service`, or None if this process has no such handler."""
    if "rospy" not in sys.modules:
        return None
    from rospy.impl.registration import get_service_manager

    return getattr(get_service_manager().get_service(service), "handler", None)


def _functions_of(value: Value) -> list[FunctionType]:
    """Return the methods of the class `value`, or the function that the callable object `value` calls."""
    found = vars(value).values() if isinstance(value, type) else [_function_of(value)]
    return [each for each in found if isinstance(each, FunctionType)]


def _function_of(value: Value) -> Value:
    """Return the student's function that a callable object calls.

    The object can be a bound method, a partial object, a wrapper, or an object with `__call__`.
    """
    while isinstance(value, partial):
        value = value.func
    if isinstance(value, MethodType):
        value = value.__func__
    if not isinstance(value, FunctionType | type) and callable(value):
        value = inspect.getattr_static(type(value), "__call__", value)
    return inspect.unwrap(value) if isinstance(value, FunctionType) else value
