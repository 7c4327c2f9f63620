"""10.5: a service that a new master hears of."""

from __future__ import annotations

import time
from contextlib import suppress

from course_pkg.errors import GraphError
from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.folder import Folder, Running
from course_pkg.examiner.scripted import closed_port
from course_pkg.examiner.waiting import until
from course_pkg.graph.rpc import MasterClient

EVERY = 0.1  # s between two looks of the watchdog
CALLS = 4  # of the master, in one look, at most
SOON = 5.0  # s for something that takes a few looks: a busy machine is no mistake
LEFT_ALONE = 0.8  # s in which a watchdog that does wrong would have done it
READY = 15.0  # s for a master to answer

# A service of the kernel's, a client of the second master that can be held up in the middle of a look, and
# the student's watchdog between them.
A_WATCH = """
import threading
import time

import rosgraph
import rospy
from std_srvs.srv import Trigger


class CheckedHandle:
    '''What a rosgraph.Master asks over; held up, it knows nobody, and a registration takes its time.'''

    def __init__(self, handle):
        self.handle = handle
        self.hold, self.inside, self.go = False, threading.Event(), threading.Event()
        self.registered, self.addresses, self.looks = [], [], 0

    def __getattr__(self, method):
        return lambda *what: self.asked(method, what)

    def asked(self, method, what):
        self.looks += 1
        if method == "registerService":
            self.addresses.append([str(each) for each in what[2:]])
            if self.hold:
                self.inside.set()
                self.go.wait(5)
            self.registered.append(time.monotonic())
        elif self.hold and method == "lookupService":
            return -1, "no provider", ""
        elif self.hold and method == "getSystemState":
            return 1, "current system state", [[], [], []]
        return getattr(self.handle, method)(*what)


class CheckedWatch:
    def open(self, kind, name, uri, every):
        self.service = rospy.Service(name, Trigger, lambda request: (True, "here"))
        master = rosgraph.Master(rospy.get_name(), uri)
        self.master = master.handle = CheckedHandle(master.handle)
        self.watchdog = kind(self.service.resolved_name, self.service.uri, master, every)
        return [self.service.uri, rospy.get_node_uri()]

    def stop_amid_a_look(self):
        '''Return whether it registers anything once stop() has returned, 0.5 s later.'''
        self.master.hold = True
        if not self.master.inside.wait(5):
            return "no look"
        stopped = []
        stopping = threading.Thread(target=lambda: (self.watchdog.stop(), stopped.append(time.monotonic())))
        stopping.start()
        stopping.join(0.3)
        self.master.hold = False
        self.master.go.set()
        stopping.join(5)
        time.sleep(0.5)
        if not stopped:
            return "stop() hangs"
        return "after stop" if any(when > stopped[0] for when in self.master.registered) else "quiet"

    def close(self):
        self.watchdog.stop()
        self.service.shutdown("checked")


checked_watch = CheckedWatch()
"""
DIED = (
    "While there was no master, a look raised, and that ended the watchdog's thread. Catch what a look may "
    "raise (OSError, rosgraph.MasterException) inside the loop, and look again."
)
NEVER = (
    "The master knows nobody by this name, and is not told. Where lookupService raises "
    "rosgraph.MasterError, call "
    "master.registerService(name, uri, rospy.get_node_uri())."
)


class SecondMaster:
    """A real master beside the kernel, which can be restarted."""

    def __init__(self, exam: Exam) -> None:
        self.port = closed_port()
        self.uri = f"http://localhost:{self.port}"
        self._folder: Folder = exam.folder()
        self._running: Running | None = None

    def start(self) -> MasterClient:
        """Start it anew, and return a client when it answers."""
        words = ("rosmaster", "--core", "-p", str(self.port))
        self._running = self._folder.start(*words, worded="a second master")
        client = MasterClient(self.uri, 1.0)
        until(lambda: _answers(client), READY)
        return client

    def stop(self) -> None:
        """End it, with all that it knows."""
        if self._running is not None:
            self._running.stop()
            self._running = None


@part(
    "10.5",
    points=3,
    goal="Register a service again when the master has forgotten it, until it is told to stop.",
    needs=["Watchdog"],
    deadline=60.0,
)
def a_watchdog(exam: Exam) -> None:
    """Have a new master, none, and another new one; then take the name, and stop in the middle of a look."""
    name = f"/{exam.draw.word()}"
    second = SecondMaster(exam)
    master = second.start()
    exam.prepare(A_WATCH)
    begun = time.monotonic()
    opened = exam.run(
        "checked_watch.open",
        Its("Watchdog"),
        name,
        second.uri,
        EVERY,
        worded="Watchdog(name, uri, master, every)",
    )
    exam.hold(
        "a Watchdog is made from a name, an address, a master and a pause",
        not opened.error,
        seen=opened.error,
        hints={
            says(
                "TimesUp"
            ): "Watchdog(...) does not come back: what goes on for ever belongs on a thread of its own.",
        },
    )
    uri, node_uri = opened.value
    try:
        _restarted(exam, name, uri, second, master)
        _registered_with(exam, uri, node_uri)
        _unhurried(exam, time.monotonic() - begun)
        _stopped(exam)
    finally:
        exam.run("checked_watch.close")
        second.stop()


def _restarted(exam: Exam, name: str, uri: str, second: SecondMaster, master: MasterClient) -> None:
    _known(exam, master, name, uri, "a master that does not know the service is told of it", NEVER)
    second.stop()
    looks = int(exam.read("checked_watch.master.looks"))
    until(lambda: int(exam.read("checked_watch.master.looks")) > looks + 2, SOON)
    exam.hold(
        "without a master it goes on looking",
        int(exam.read("checked_watch.master.looks")) > looks + 2,
        expected="look after look",
        seen="no look any more",
        hints=DIED,
    )
    master = second.start()
    _known(exam, master, name, uri, "a master that was restarted is told again", DIED)
    _quiet(exam)
    _taken(exam, master, name)
    _known(
        exam,
        master,
        name,
        uri,
        "a name that is free again is taken",
        "The other one has gone: look again and again.",
    )


def _known(exam: Exam, master: MasterClient, name: str, uri: str, rule: str, hint: str) -> None:
    seen = until(lambda: master.lookup_service(name), SOON) or "nobody"
    asked = seen != "nobody" or int(exam.read("checked_watch.master.looks"))
    exam.hold(
        rule,
        seen != "nobody",
        expected="the service on its books",
        seen="nobody by this name",
        hints=hint if asked else "The master that it was given was never asked. Ask that one: self.master.",
    )
    exam.hold(
        "it is registered at its own address",
        seen == uri,
        expected="the uri that it was given",
        seen="another address",
        hints=("The address of a service begins with rosrpc, and comes second. The node's own goes last."),
    )


def _taken(exam: Exam, master: MasterClient, name: str) -> None:
    """Give the name to another node, which serves it by right: the last one wins."""
    other = f"rosrpc://localhost:{closed_port()}"
    master.register_service("/another", name, other, f"http://localhost:{closed_port()}/")
    fought = until(lambda: master.lookup_service(name) != other, LEFT_ALONE)
    master.unregister_service("/another", name, other)
    exam.hold(
        "a name that another node has taken is left to it",
        not fought,
        expected="the other node's address",
        seen="the student's again",
        hints="Another node serves this name now, and the watchdog took it away. With two such "
        "watchdogs they would fight for ever. Register only where the master knows nobody.",
    )


def _registered_with(exam: Exam, uri: str, node_uri: str) -> None:
    given = exam.read("checked_watch.master.addresses")
    exam.hold(
        "it is registered at its own address",
        given[0] == [uri, node_uri],
        expected="the service's uri, and then rospy.get_node_uri()",
        seen=", ".join(given[0]),
        hints="The last of the three words is the address of the node: rospy.get_node_uri().",
    )


def _unhurried(exam: Exam, took: float) -> None:
    """Hold that it waits between two looks; more than one in each pause there cannot be."""
    looks = int(exam.read("checked_watch.master.looks"))
    exam.hold(
        "it looks again and again",
        looks < CALLS * (took / EVERY + 5),
        expected=f"a look every {EVERY:g} s",
        seen=f"{looks / took:.0f} a second",
        hints="Between two looks there is no pause: wait `every` s each time, also after a look that failed.",
    )


def _quiet(exam: Exam) -> None:
    before = len(exam.read("checked_watch.master.registered"))
    looks = int(exam.read("checked_watch.master.looks"))
    until(lambda: int(exam.read("checked_watch.master.looks")) > looks + 3, SOON)
    looked = int(exam.read("checked_watch.master.looks")) - looks
    again = len(exam.read("checked_watch.master.registered")) - before
    exam.hold(
        "where all is well it only looks",
        again == 0,
        expected="no registration",
        seen=f"{again} of them",
        hints="The master knew the service, and was told of it again and again. Look it up first.",
    )
    exam.hold("it looks again and again", looked > 3, expected="look after look", seen=f"{looked} of them")


def _stopped(exam: Exam) -> None:
    outcome = exam.run("checked_watch.stop_amid_a_look", within=20.0, worded="stop()")
    exam.expect(
        "after stop() nothing is registered any more",
        expected="quiet",
        seen=outcome.value,
        hints={
            "after stop": "stop() returned in the middle of a look, and that look registered the service "
            "afterwards. Have stop() "
            "wait for the look that is under way: join the thread, or share a lock with it.",
            "stop() hangs": "stop() waits for itself: a lock that is held already, or a thread that was not "
            "told to end.",
            "no look": "It looked no more before it was told to stop.",
        },
    )


def _answers(master: MasterClient) -> bool:
    with suppress(GraphError):
        return bool(master.pid())
    return False
