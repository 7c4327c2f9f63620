"""Replace a method of rospy with a method that also records calls or messages."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from functools import wraps
from types import ModuleType
from typing import Any

from rospy.impl.tcpros_base import TCPROSTransport

HOOKED = "hooked_by_course"  # This attribute marks a method that has been replaced.
TRANSPORT = "TCPROSTransport"  # rospy's modules create their connections with the class that has this name.

Method = Callable[..., Any]  # rospy has no type annotations.


class Hook:
    """A method of the object `owner`, and the function that returns a replacement for this method.

    `uses` lists global names that the code of the replaced method must contain. A hook fits only if the
    method has the expected parameters and contains these names.
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
        """Return whether the method has the expected parameters and uses the expected names."""
        method = getattr(self._owner, self._name, None)
        if not inspect.isfunction(method):
            return False
        known = self._uses <= {*inspect.unwrap(method).__code__.co_names}
        return known and tuple(inspect.signature(method).parameters) == self._parameters

    def install(self) -> None:
        """Replace the method; a second call has no effect."""
        method = getattr(self._owner, self._name)
        if not hasattr(method, HOOKED):
            replacement = wraps(method)(self._replace(method))
            setattr(replacement, HOOKED, True)
            setattr(self._owner, self._name, replacement)


def install_all(
    hooks: Sequence[Hook], module: ModuleType, transport: type, required: Sequence[Hook] = ()
) -> bool:
    """Install all hooks, and make the module `module` create its connections with the class `transport`.

    If any hook does not fit, the function changes nothing and returns False. The hooks in `required` are
    checked, but not installed.
    """
    current = getattr(module, TRANSPORT, None)
    known = isinstance(current, type) and issubclass(current, TCPROSTransport)
    if not known or not all(hook.fits() for hook in (*hooks, *required)):
        return False
    setattr(module, TRANSPORT, transport)
    for hook in hooks:
        hook.install()
    return True
