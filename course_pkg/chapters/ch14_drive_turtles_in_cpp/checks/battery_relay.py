"""14.7 and 14.8: servers that receive the calls of /battery from the handlers of /report."""

from __future__ import annotations

import threading
import time
from contextlib import suppress
from queue import SimpleQueue

import rospy
from std_srvs.srv import Trigger

from course_pkg.checking.peers.scripted_server import Act, Refuse
from course_pkg.checking.plain_values import Message

HOLDING = 8.0  # A call of /battery is held for at most this time in s.
GATHERING = 3.0  # The relay waits at most this time in s until all calls have arrived.


class BatteryRelay:
    """Passes on calls of /battery to the program, but only after `calls` of them have arrived.

    At this moment, each of these calls occupies one thread of the program, the thread of its /report. So a
    program without a further thread can never respond, and the result does not depend on the speed of the
    machine.
    """

    def __init__(self, name: str, calls: int) -> None:
        self._arrived = threading.Barrier(calls)
        self._free: SimpleQueue[rospy.ServiceProxy] = SimpleQueue()
        # The connections exist before the master gets the relay's address for `name`.
        for _ in range(calls):
            proxy = rospy.ServiceProxy(name, Trigger, persistent=True)
            proxy()
            self._free.put(proxy)

    def answer(self, _: Message) -> Act:
        """Wait for the other calls, pass on this call, and return the program's response."""
        with suppress(threading.BrokenBarrierError):
            self._arrived.wait(GATHERING)
        proxy = self._free.get()
        try:
            response = proxy()
        except (rospy.ServiceException, OSError):
            return Refuse("the program has ended")
        finally:
            self._free.put(proxy)
        return {"success": response.success, "message": response.message}


class BatteryGate:
    """Holds all calls of /battery until the event `opened` is set, and counts them."""

    def __init__(self) -> None:
        self.opened = threading.Event()
        self.held = 0

    def answer(self, _: Message) -> Act:
        """Wait until the gate is open, and return a response."""
        self.held += 1
        self.opened.wait(HOLDING)
        return {"success": True, "message": "held"}

    def wait_for_the_last(self, quiet: float) -> None:
        """Return when no further call arrives within the time `quiet` (s)."""
        before = -1
        while before != self.held:
            before = self.held
            time.sleep(quiet)
