"""12.2: an object of the student's class Till in the kernel, and a purse that reveals a missing lock."""

from __future__ import annotations

import threading
from collections import Counter

from course_pkg.checking import CheckContext, Its
from course_pkg.checking.kernel.small_stacks import SMALL_STACKS
from course_pkg.checking.placed import remote
from course_pkg.checking.plain_values import Value
from course_pkg.checking.result import Result

MEETING = 0.05  # A call of take() waits up to this time in s for another call with the same amount.
FIRST_MEETING = 0.5  # The first of many calls waits up to this time in s, so that all other calls can start.
KERNEL_CODE = (
    SMALL_STACKS
    + """
import rospy
from course_pkg.srv import Charge


class CheckedDesk:
    def open(self, kind, purse, name):
        small_stacks.begin()
        self.till = kind(purse)
        self.service = rospy.Service(name, Charge, self.till.handle_charge)

    def close(self):
        small_stacks.end()
        self.service.shutdown("checked")


checked_desk = CheckedDesk()
"""
)


class CheckedPurse:
    """A purse for the student's till. The student's code in the kernel uses the purse through a proxy object.

    Each call of take() waits for a short time, and ends early if another call has the same amount. Therefore,
    if the student's code uses no lock, a request and its repetition always run at the same time.
    """

    def __init__(self) -> None:
        self.took: list[Value] = []
        self.stuck = False  # `stuck` is True if the next call of take() fails.
        self.meeting = MEETING
        self._long_waits = 0
        self._asked: Counter[str] = Counter()
        self._turn = threading.Condition()

    @remote
    def take(self, cents: Value) -> None:
        """Take this amount of money from the purse."""
        with self._turn:
            amount = str(cents)
            self._asked[amount] += 1
            mine = self._asked[amount]
            self._turn.notify_all()
            limit = FIRST_MEETING if self._long_waits > 0 else self.meeting
            self._long_waits -= 1
            self._turn.wait_for(lambda: self._asked[amount] > mine, limit)
            if self.stuck:
                self.stuck = False
                raise RuntimeError("the money drawer is blocked")
            self.took.append(cents)

    def await_crowd(self) -> None:
        """Let the next call of take() wait longer, so that the other calls can start on a busy machine."""
        self._long_waits = 1


def opened_till(context: CheckContext, name: str) -> tuple[CheckedPurse, Result]:
    """Offer the service `name` with a new Till; return the Till's purse, and the result of Till(purse)."""
    purse = CheckedPurse()
    context.place("checked_purse", purse)
    its = Its("Till"), Its("checked_purse")
    return purse, context.run("checked_desk.open", *its, name, worded="Till(purse)")
