"""A shelf that shows whether the student's code uses a lock, and a shop in the kernel with this shelf."""

from __future__ import annotations

import threading

from course_pkg.checking import matches
from course_pkg.checking.kernel.small_stacks import SMALL_STACKS
from course_pkg.checking.placed import remote
from course_pkg.checking.plain_values import Value

TRIGGER = "std_srvs/Trigger"
CALLERS = 50
ONE = 6.0  # ONE is the time limit in s for a single call.
SHELF_ERRORS = [
    (
        matches("field message must be"),
        "The field `message` has to be a string. Convert the number with str(...).",
    ),
    (
        matches("Shelf' object has no attribute"),
        (
            "Your code uses a method that a shelf does not have. Use only the two methods read() and "
            "write(count)."
        ),
    ),
]
MANY = 20.0  # MANY is the time limit in s for 50 simultaneous calls on a busy machine.
MEETING = 0.01  # A thread waits up to this time in s for another thread.
# The first of many threads waits up to this time in s until the other threads have started.
FIRST_MEETING = 0.3
FIRST = 2  # In this many calls, read() and write() wait for up to FIRST_MEETING s.
ENTERING = 2.0  # The first of many handlers waits up to this time in s for the second handler.
LATE = 7  # With many threads, every seventh read is late.
LATE_READ = 0.05  # A late read waits up to this time in s for a write of another thread.

KERNEL_CODE = (
    SMALL_STACKS
    + """
import rospy
from std_srvs.srv import Trigger


class CheckedShop:
    original = None  # the method ServiceProxy.call while count_calls() replaces it

    def open(self, kind, shelf, services, *others):
        small_stacks.begin()
        self.one = kind(shelf, *others)

        def recorded(handler):
            def handle(request):
                shelf.enter()
                return handler(request)

            return handle

        handlers = [(name, getattr(self.one, handler)) for name, handler in services.items()]
        self.services = [rospy.Service(name, Trigger, recorded(handler)) for name, handler in handlers]

    def count_calls(self, name):
        '''Count the calls of the service `name`, which does not exist, until close() is called.'''
        self.calls, self.original = 0, rospy.ServiceProxy.call

        def call(proxy, *args, **named):
            self.calls += proxy.resolved_name == name
            return self.original(proxy, *args, **named)

        rospy.ServiceProxy.call = call

    def close(self):
        small_stacks.end()
        if self.original:
            rospy.ServiceProxy.call, self.original = self.original, None
        for service in self.services:
            service.shutdown("checked")


checked_shop = CheckedShop()
"""
)


class CheckedShelf:
    """A shelf with `count` things. The student's code in the kernel uses the shelf through a proxy object.

    Each read and each write waits for a short time; the wait ends early if another thread reads. Therefore,
    two threads without a lock read the same number.

    With many threads, some reads are late: they wait for a write of another thread, and then return the new
    number. So a thread that reads the number without the lock gets the number of another thread.
    """

    def __init__(self, count: int) -> None:
        self.things: Value = count
        self.together = False  # `together` is True if two handlers ran at the same time.
        self._entered = 0
        self._reads = 0
        self._writes = 0
        self._crowded = False
        self._long_waits = 0
        self._turn = threading.Condition()

    def await_crowd(self) -> None:
        """Let the next calls of read() and write() wait until the other threads have started.

        From now on, some reads are late.
        """
        self._crowded = True
        self._long_waits = FIRST

    @remote
    def enter(self) -> None:
        """Begin to handle a request; the first of many handlers waits until the second handler begins."""
        if not self._crowded:
            return
        with self._turn:
            self._entered += 1
            self._turn.notify_all()
            if self._entered == 1:
                self.together = self._turn.wait_for(lambda: self._entered > 1, ENTERING)

    @remote
    def read(self) -> Value:
        """Return the number of things on the shelf."""
        with self._turn:
            seen = self.things
            self._reads += 1
            late = self._crowded and self._reads % LATE == 0
            self._turn.notify_all()
            self._meet()
            if late:
                so_far = self._writes
                self._turn.wait_for(lambda: self._writes > so_far, LATE_READ)
                seen = self.things
        return seen

    @remote
    def write(self, count: Value) -> None:
        """Set the number of things on the shelf."""
        with self._turn:
            self._meet()
            self.things = count
            self._writes += 1
            self._turn.notify_all()

    def _meet(self) -> None:
        so_far = self._reads
        limit = FIRST_MEETING if self._long_waits > 0 else MEETING
        self._long_waits -= 1
        self._turn.wait_for(lambda: self._reads > so_far, limit)
