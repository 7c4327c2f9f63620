"""14.7: a server that receives the calls of /battery from the handlers of /report, and passes them on."""

from __future__ import annotations

import threading
from contextlib import suppress
from queue import SimpleQueue

import rospy
from std_srvs.srv import Trigger

from course_pkg.checking.peers.scripted_server import Act, Refuse
from course_pkg.checking.plain_values import Message

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
