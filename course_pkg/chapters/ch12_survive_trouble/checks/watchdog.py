"""12.4: a thread that registers a service again after a restart of the master."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress

from course_pkg.chapters.ch12_survive_trouble.checks.watchdog_in_kernel import KERNEL_CODE, CheckedMaster
from course_pkg.checking import CheckContext, Its, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.commands.folder import Folder, Running
from course_pkg.checking.peers.node import closed_port
from course_pkg.errors import GraphError
from course_pkg.ros.protocol.master_api import MasterClient
from course_pkg.waiting import wait_until

EVERY = 0.1  # EVERY is the time in s between two polls of the watchdog.
SELDOM = 0.16  # The shortest of many pauses must be less than this time in s, even on a busy machine.
# If the shortest pause is less than this time in s, a watchdog that polls too rarely has growing pauses.
GROWN = 0.5
CALLS = 4  # CALLS is the maximum number of calls to the master in one poll.
SOON = 5.0  # SOON is the time limit in s for a few polls on a busy machine.
# While the master is stopped, the check waits up to this time in s for the watchdog's polls.
AWAY = 3.0
LEFT_ALONE = 0.8  # A wrong watchdog would register its service again within this time in s.
LATE = 0.5  # After stop(), the check waits this time in s for a wrong registration.
LAST = 2  # After stop(), the watchdog may make at most this many polls.
READY = 15.0  # READY is the time limit in s for the start of a master.

ENDLESS = "Watchdog(...) does not return. Run the endless loop in a thread that you start in __init__."
DIED = (
    "An error ended the watchdog's thread while no master was running. Catch OSError and "
    "rosgraph.MasterException inside the loop."
)
ONCE = "The watchdog stopped polling although a master was running. Poll in a loop until stop() is called."
NEVER = (
    "The master does not know the name, and the watchdog has not registered the service again. Register "
    "the service each time lookupService() raises rosgraph.MasterError."
)
GREW = (
    "The pauses between the polls grew while no master was running. After each poll, wait for the "
    "time in the argument `every`, even if the poll failed several times."
)
TOO_RARELY = (
    "The watchdog polls too rarely. Between two polls, wait only for the time in the argument `every`."
)


class SecondMaster:
    """A second real master, which the check can restart."""

    def __init__(self, context: CheckContext) -> None:
        self.port = closed_port()
        self.uri = f"http://localhost:{self.port}"
        self._folder: Folder = context.folder()
        self._running: Running | None = None

    def start(self) -> MasterClient:
        """Start a master without registrations; return a client as soon as the master responds."""
        words = ("rosmaster", "--core", "-p", str(self.port))
        self._running = self._folder.start(*words, worded="a second master")
        client = MasterClient(self.uri, 1.0)
        wait_until(lambda: _answers(client), READY)
        return client

    def stop(self) -> None:
        """Stop the master; all registrations are then lost."""
        if self._running is not None:
            self._running.stop()
            self._running = None


REGISTERED = "Register the service again if the master does not know the service."


@part(
    "12.4",
    points=3,
    goal=(
        "Write a watchdog: until stop() is called, it registers a service again if the master does "
        "not know the service."
    ),
    needs=["Watchdog"],
    deadline=60.0,
    goals={REGISTERED: 2, "Poll the master at intervals, and end when stop() is called.": 1},
)
def a_watchdog(context: CheckContext) -> None:
    """Start, stop and restart a master; register another node; then stop the watchdog during a poll."""
    name = f"/{context.random.word()}"
    second = SecondMaster(context)
    master = second.start()
    watched = CheckedMaster(second.uri, slow=context.random.number(1.2, 2.2))
    context.place("checked_master", watched)
    context.prepare(KERNEL_CODE)
    begun = time.monotonic()
    opened = context.run(
        "checked_watch.open",
        Its("Watchdog"),
        name,
        second.uri,
        EVERY,
        worded="Watchdog(name, uri, master, every)",
    )
    context.require(
        "a Watchdog can be created with a name, an address, a master and a pause",
        holds=not opened.error,
        actual=opened.error,
        hints=[(matches("TimesUp"), ENDLESS)],
    )
    uri, node_uri = opened.returned(list)
    try:
        _registers_again(context, watched, name, uri, second, master)
        context.fulfilled(REGISTERED)
        _registers_both_addresses(context, watched, uri, node_uri)
        _polls_with_pauses(context, watched, time.monotonic() - begun)
        _stops(context, watched, lambda: _returns(context, master, name, uri))
    finally:
        context.run("checked_watch.close")
        second.stop()


def _registers_again(
    context: CheckContext,
    watched: CheckedMaster,
    name: str,
    uri: str,
    second: SecondMaster,
    master: MasterClient,
) -> None:
    unknown = "the watchdog registers a service that the master does not know"
    _is_registered(context, watched, master, name, uri, unknown, NEVER)
    looks = watched.looks
    polls = wait_until(lambda: watched.looks > looks + 1, SOON)
    second.stop()
    looks = watched.looks
    polled = wait_until(lambda: watched.looks > looks + 2, AWAY)
    often = not polled or bool(wait_until(lambda: watched.looks > looks + 5, AWAY))
    master = second.start()
    # A watchdog can poll in a way that is not counted here, for example with rosgraph.is_master_online. The
    # check therefore also accepts a watchdog that registers the service again.
    context.require(
        "without a master, the watchdog continues to poll",
        holds=polled or bool(wait_until(lambda: master.lookup_service(name), SOON)),
        expected="further polls",
        actual="no further poll",
        hints=DIED if polls else ONCE,
    )
    if not often:
        grew = watched.gap < GROWN
        context.fail(
            "the watchdog polls the master at intervals of `every` seconds",
            expected=f"a poll every {EVERY:g} s, even without a master",
            actual="longer and longer pauses" if grew else f"a poll every {watched.gap:.1f} s",
            hint=GREW if grew else TOO_RARELY,
        )
    restarted = "after a restart of the master, the watchdog registers the service again"
    _is_registered(context, watched, master, name, uri, restarted, DIED)
    _only_polls(context, watched)
    _leaves_the_name(context, master, name)
    _is_registered(
        context,
        watched,
        master,
        name,
        uri,
        "the watchdog registers a name that is free again",
        (
            "The name is free again, but the watchdog does not register its own service. After a poll "
            "that finds another provider, continue to poll."
        ),
    )


def _is_registered(
    context: CheckContext,
    watched: CheckedMaster,
    master: MasterClient,
    name: str,
    uri: str,
    assertion: str,
    hint: str,
) -> None:
    seen = wait_until(lambda: master.lookup_service(name), SOON) or "nobody"
    asked = seen != "nobody" or watched.looks
    context.require(
        assertion,
        holds=seen != "nobody",
        expected="a registered service",
        actual="no provider of this name",
        hints=hint
        if asked
        else (
            "The watchdog did not use the argument `master`. Store this argument in self, and call its "
            "methods."
        ),
    )
    context.require(
        "the watchdog registers the address of the service and the address of the node",
        holds=seen == uri,
        expected="the argument `uri`",
        actual="another address",
        hints=(
            "registerService() got the addresses in the wrong order. First pass the address of the "
            "service (it begins with rosrpc), and then the address of the node."
        ),
    )


def _leaves_the_name(context: CheckContext, master: MasterClient, name: str) -> None:
    """Register the service for another node; assert that the watchdog does not replace this registration."""
    other = f"rosrpc://localhost:{closed_port()}"
    master.register_service("/another", name, other, f"http://localhost:{closed_port()}/")
    fought = wait_until(lambda: master.lookup_service(name) != other, LEFT_ALONE)
    master.unregister_service("/another", name, other)
    context.require(
        "the watchdog does not register a name that another node has registered",
        holds=not fought,
        expected="the other node's address",
        actual="the address of your service",
        hints=(
            "Another node provides this service now, but the watchdog registered its own service. "
            "Register the service only if the master knows no provider of the name."
        ),
    )


def _registers_both_addresses(context: CheckContext, watched: CheckedMaster, uri: str, node_uri: str) -> None:
    given = watched.addresses[0] if watched.addresses else []
    context.require(
        "the watchdog registers the address of the service and the address of the node",
        holds=given == [uri, node_uri],
        expected="the address of the service, and then rospy.get_node_uri()",
        actual=", ".join(given) or "no registration at the given master",
        hints=(
            "The last argument of registerService() is wrong. Pass rospy.get_node_uri(), which is the "
            "address of the node."
        ),
    )


def _polls_with_pauses(context: CheckContext, watched: CheckedMaster, took: float) -> None:
    """Assert that the watchdog pauses between polls: within `took` s, it must not poll too often."""
    looks = watched.looks
    context.require(
        "the watchdog polls the master at intervals of `every` seconds",
        holds=looks < CALLS * (took / EVERY + 5),
        expected=f"a poll every {EVERY:g} s",
        actual=f"{looks / took:.0f} polls per second",
        hints=(
            "The watchdog polls without a pause. After each poll, wait for the time in the argument "
            "`every`, even if the poll failed."
        ),
    )


def _only_polls(context: CheckContext, watched: CheckedMaster) -> None:
    before, looks = len(watched.registered), watched.looks
    wait_until(lambda: watched.looks > looks + 3, SOON)
    looked = watched.looks - looks
    again = len(watched.registered) - before
    context.require(
        "the watchdog does not register a registered service again",
        holds=again == 0,
        expected="no registration",
        actual=f"registrations: {again}",
        hints=(
            "The watchdog registers a name that the master already knows. Look up the name before you "
            "register it."
        ),
    )
    context.require(
        "the watchdog polls the master at intervals of `every` seconds",
        holds=looked > 3,
        expected="further polls",
        actual=f"polls: {looked}",
    )
    context.require(
        "the watchdog polls the master at intervals of `every` seconds",
        holds=wait_until(lambda: watched.gap < SELDOM, AWAY),
        expected=f"a poll every {EVERY:g} s",
        actual=f"a poll every {watched.gap:.1f} s",
        hints=TOO_RARELY,
    )


STOPPED = "no registration, and no further polls"
NOT_STOPPED: Hints = [
    (
        "a registration after stop()",
        (
            "The thread registered the service after stop() had returned. In stop(), wait for the "
            "thread with join(), or use a lock."
        ),
    ),
    (
        "further polls",
        (
            "The thread continued to poll the master after stop() had returned. In stop(), set a flag, and "
            "end the loop of the thread when the flag is set."
        ),
    ),
    (
        "stop() does not end",
        (
            "stop() does not return. Check whether stop() waits for a lock that is always held, or for "
            "a thread that does not end."
        ),
    ),
]


def _returns(context: CheckContext, master: MasterClient, name: str, uri: str) -> bool:
    """Unregister the service, and return whether the kernel registers it again over any connection."""
    master.unregister_service(str(context.run("rospy.get_name").value), name, uri)
    return bool(wait_until(lambda: master.lookup_service(name), LATE))


def _stops(context: CheckContext, watched: CheckedMaster, returns: Callable[[], bool]) -> None:
    context.expect(
        "after stop(), the watchdog registers nothing",
        expected=STOPPED,
        actual=_stopped_amid_a_look(context, watched, returns),
        hints=NOT_STOPPED,
    )


def _stopped_amid_a_look(context: CheckContext, watched: CheckedMaster, returns: Callable[[], bool]) -> str:
    """Call stop() during a poll; return `STOPPED` if the watchdog then stops correctly.

    `returns` unregisters the service, and returns whether the service is registered again.

    After stop(), a right watchdog does not register the service again, and makes at most `LAST` polls.
    """
    watched.hold()
    if not watched.inside.wait(SOON):
        return "no poll before stop()"
    result = context.run("checked_watch.stop", within=SOON, worded="stop()")
    stopped = watched.stopped_at
    if stopped is None:
        return "stop() does not end"
    result.returned()
    if returns() or any(when > stopped for when in watched.registered):
        return "a registration after stop()"
    return "further polls" if watched.polls_after(stopped) > LAST else STOPPED


def _answers(master: MasterClient) -> bool:
    with suppress(GraphError):
        return bool(master.pid())
    return False
