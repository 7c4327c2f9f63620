"""Records the calls of the student's watchdog to the master, and can delay a registration.

The watchdog runs in the kernel. Its calls go to a CheckedMaster object, which calls the real master.
"""

from __future__ import annotations

import threading
import time
from collections import Counter

from course_pkg.checking.placed import remote
from course_pkg.checking.plain_values import Value
from course_pkg.ros.protocol.xmlrpc import XmlRpcClient

TIMEOUT = 5.0  # TIMEOUT is the time limit in s for a call to the master.
PAUSE = 5.0  # A registration waits up to this time in s.

# The code defines a service in the kernel, and starts the student's watchdog. The watchdog's calls to the
# master go through the check runner.
KERNEL_CODE = """
import rosgraph
import rospy
from std_srvs.srv import Trigger


class CheckedHandle:
    def __getattr__(self, method):
        return lambda *what: checked_master.ask(method, list(what))


class CheckedWatch:
    def open(self, kind, name, uri, every):
        self.service = rospy.Service(name, Trigger, lambda request: (True, "here"))
        master = rosgraph.Master(rospy.get_name(), uri)
        master.handle = CheckedHandle()
        self.watchdog = kind(self.service.resolved_name, self.service.uri, master, every)
        return [self.service.uri, rospy.get_node_uri()]

    def stop(self):
        master = checked_master  # The student's code can change global names, but not this local name.
        master.stopping()
        self.watchdog.stop()
        master.stopped()

    def close(self):
        self.watchdog.stop()
        self.service.shutdown("checked")


checked_watch = CheckedWatch()
"""


class CheckedMaster:
    """Calls a master for the watchdog, and records these calls.

    After hold(), the master reports that it knows no services. The watchdog therefore registers its service
    again. This registration waits until stop() has returned. But stop() may wait for the watchdog's thread.
    Therefore, the registration also continues when `slow` s have passed since the call of stop(). Without a
    call of stop(), the registration continues after `PAUSE` s.
    """

    def __init__(self, uri: str, slow: float) -> None:
        # For each registration call, `addresses` contains the address of the service and the address of the
        # node.
        self.addresses: list[list[str]] = []
        # `registered` contains the times of the registrations (s, time.monotonic()).
        self.registered: list[float] = []
        self.looks = 0  # `looks` is the number of calls to the master.
        # `polls` contains the method and the time of each call that is not a registration.
        self.polls: list[tuple[str, float]] = []
        self.gap = 60.0  # `gap` is the shortest time in s between two consecutive calls of the same method.
        self.inside = threading.Event()  # This event is set while a registration waits.
        self.stopped_at: float | None = None
        self._uri, self._slow = uri, slow
        self._times: dict[str, float] = {}
        self._holds = False
        self._go = threading.Event()
        self._lock = threading.Lock()

    @remote
    def ask(self, method: str, what: list[Value]) -> Value:
        """Return the response of the master; raise OSError if the master does not run."""
        with self._lock:
            self.looks += 1
            self._note(method)
        if method == "registerService":
            self.addresses.append([str(each) for each in what[2:]])
            if self._holds:
                self.inside.set()
                self._go.wait(PAUSE)
            self.registered.append(time.monotonic())
        elif self._holds and method == "lookupService":
            return [-1, "no provider", ""]
        elif self._holds and method == "getSystemState":
            return [1, "current system state", [[], [], []]]
        return XmlRpcClient(self._uri, TIMEOUT).ask(method, *what)

    @remote
    def stopping(self) -> None:
        """After stop() was called, let a waiting registration continue, but only after `slow` s."""
        threading.Timer(self._slow, self._release).start()

    @remote
    def stopped(self) -> None:
        """Record the time at which stop() returned, and let a waiting registration continue."""
        self.stopped_at = time.monotonic()
        self._release()

    def polls_after(self, when: float) -> int:
        """Return the number of polls that began after the time `when` (s, time.monotonic())."""
        return max(Counter(method for method, at in self.polls.copy() if at > when).values(), default=0)

    def hold(self) -> None:
        """From now on, report that the master knows no services, and let the next registration wait."""
        self._holds = True

    def close(self) -> None:
        """Let a waiting registration continue."""
        self._release()

    def _release(self) -> None:
        self._holds = False
        self._go.set()

    def _note(self, method: str) -> None:
        """Record the time of a call that is not a registration."""
        now = time.monotonic()
        if method != "registerService":
            self.gap = min(self.gap, now - self._times.get(method, now - self.gap))
            self._times[method] = now
            self.polls.append((method, now))
