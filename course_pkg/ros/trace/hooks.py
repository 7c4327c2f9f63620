"""Replacing a method of rospy by one that also records what happens, where rospy offers no hook for it."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from functools import wraps
from types import ModuleType
from typing import Any

from rospy.impl.tcpros_base import TCPROSTransport

HOOKED = "hooked_by_course"  # an attribute of a method that has been replaced
TRANSPORT = "TCPROSTransport"  # the name by which rospy's modules create their connections

Method = Callable[..., Any]  # rospy has no types


class Hook:
    """A method of `owner` and the function that returns its replacement.

    `uses` are the globals that the method has to look up. If the method of this rospy has other parameters or
    does not use these globals, the hook does not fit.
    """

    def __init__(
        self,
        owner: type | ModuleType,
        name: str,
        parameters: Sequence[str],
        replace: Callable[[Method], Method],
        uses: Sequence[str] = (),
    ) -> None:
        self._owner = owner
        self._name = name
        self._parameters = tuple(parameters)
        self._replace = replace
        self._uses = frozenset(uses)

    def fits(self) -> bool:
        """Return whether the method is as expected."""
        method = getattr(self._owner, self._name, None)
        if not inspect.isfunction(method):
            return False
        known = self._uses <= {*inspect.unwrap(method).__code__.co_names}
        return known and tuple(inspect.signature(method).parameters) == self._parameters

    def install(self) -> None:
        """Replace the method; a second time changes nothing."""
        method = getattr(self._owner, self._name)
        if not hasattr(method, HOOKED):
            replacement = wraps(method)(self._replace(method))
            setattr(replacement, HOOKED, True)
            setattr(self._owner, self._name, replacement)


def install_all(
    hooks: Sequence[Hook], module: ModuleType, transport: type, required: Sequence[Hook] = ()
) -> bool:
    """Install all hooks and have `module` create its connections as `transport`; return whether it worked.

    If one of `hooks` does not fit, or one of `required`, which are only checked, nothing is changed.
    """
    current = getattr(module, TRANSPORT, None)
    known = isinstance(current, type) and issubclass(current, TCPROSTransport)
    if not known or not all(hook.fits() for hook in (*hooks, *required)):
        return False
    setattr(module, TRANSPORT, transport)
    for hook in hooks:
        hook.install()
    return True
