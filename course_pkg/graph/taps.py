"""Replacing a method of rospy by one that also takes down what happens, where rospy has no hook for it."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from functools import wraps
from typing import Any

from rospy.impl.tcpros_base import TCPROSTransport

TAPPED = "tapped_by_course"  # an attribute of a method that has been replaced

Method = Callable[..., Any]
Transport: Any = TCPROSTransport  # rospy has no types


MADE_HERE = "TCPROSTransport"  # the name by which rospy's modules make their connections


class Tap:
    """A method of `owner` and what makes another one of it; `uses` are the globals that it has to look up.

    A rospy whose method has other parameters does not fit, and is best left alone.
    """

    def __init__(
        self,
        owner: Any,  # noqa: ANN401 -- a class or a module
        name: str,
        parameters: Sequence[str],
        made: Callable[[Method], Method],
        uses: Sequence[str] = (),
    ) -> None:
        self._owner = owner
        self._name = name
        self._parameters = tuple(parameters)
        self._made = made
        self._uses = frozenset(uses)

    def fits(self) -> bool:
        """Say whether the method is as expected."""
        bare = getattr(self._owner, self._name, None)
        if not inspect.isfunction(bare):
            return False
        known = self._uses <= {*inspect.unwrap(bare).__code__.co_names}
        return known and tuple(inspect.signature(bare).parameters) == self._parameters

    def put(self) -> None:
        """Replace the method; a second time changes nothing."""
        bare = getattr(self._owner, self._name)
        if not hasattr(bare, TAPPED):
            tapped = wraps(bare)(self._made(bare))
            setattr(tapped, TAPPED, True)
            setattr(self._owner, self._name, tapped)


def put_all(taps: Sequence[Tap], module: Any, transport: type, used: Sequence[Tap] = ()) -> bool:  # noqa: ANN401
    """Put all taps and have `module` make its connections as `transport`; say whether it could be done.

    If one of the taps, or of those that are `used` and stay as they are, does not fit, all is left alone.
    """
    bare = getattr(module, MADE_HERE, None)
    known = isinstance(bare, type) and issubclass(bare, TCPROSTransport)
    if not known or not all(tap.fits() for tap in (*taps, *used)):
        return False
    setattr(module, MADE_HERE, transport)
    for tap in taps:
        tap.put()
    return True
