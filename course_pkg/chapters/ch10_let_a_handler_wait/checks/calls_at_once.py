"""10.1: a client that calls one service from several threads at the same time."""

from __future__ import annotations

import threading
import time

from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.kernel.small_stacks import SMALL_STACKS
from course_pkg.checking.peers.scripted_server import ScriptedServer
from course_pkg.checking.placed import remote
from course_pkg.checking.plain_values import Message, Value
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.waiting import wait_until

TRIGGER = "std_srvs/Trigger"
TOGETHER = 1.0  # The server waits up to this time in s until the other calls have arrived.
LIMIT = 6.0  # LIMIT is the time limit in s for the student's function.
# The student's function must return within this time in s after the last response. If a function sleeps for a
# fixed time instead of joining its threads, it can take longer.
PROMPT = 0.3
# In one run, a single call takes a random time between these limits (s). The time is longer than a join with
# a timeout of 2 s.
SHORTEST, LONGEST = 2.2, 2.8
# If the student's function returns too late, the check adds a run in which each call takes this additional
# time in s.
LONGER = 1.0

# This code reports each call of a persistent proxy to the check. The thread that makes the call also sends
# the report.
KERNEL_CODE = (
    SMALL_STACKS
    + """
import rospy


class ProxyWatch:
    def begin(self):
        self.caller = rospy.get_name()
        small_stacks.begin()
        self.proxies, self.original = [], rospy.ServiceProxy.call

        def call(proxy, *args, **named):
            if proxy.persistent:
                self.proxies.append(proxy)  # stored, so that no later object gets the same id
                checked_proxies.called(id(proxy))
            return self.original(proxy, *args, **named)

        rospy.ServiceProxy.call = call

    def end(self):
        rospy.ServiceProxy.call = self.original
        self.proxies = []
        small_stacks.end()


proxy_watch = ProxyWatch()
"""
)
SHARED = (
    "Two threads call the same persistent proxy, so both threads use one connection at the same "
    "time. Create a proxy in each thread, or share a proxy without persistent=True."
)


class Proxies:
    """For each persistent proxy, records the threads that use this proxy."""

    def __init__(self) -> None:
        self.calls = 0
        self._threads: dict[str, set[threading.Thread]] = {}

    @remote
    def called(self, proxy: Value) -> None:
        """Record that the current thread makes a call through the persistent proxy with the id `proxy`."""
        self._threads.setdefault(str(proxy), set()).add(threading.current_thread())
        self.calls += 1

    @property
    def shared(self) -> bool:
        """Whether several threads have used the same proxy."""
        return any(len(threads) > 1 for threads in self._threads.values())


class Gate:
    """A server that waits until `count` calls arrive, or for `TOGETHER` s; it responds `hold` s later.

    Its messages are the texts in `words`. If there are several messages, the field `success` of the first
    response is False.
    """

    def __init__(self, count: int, words: list[str], hold: float = 0.0) -> None:
        self.most = 0  # `most` is the maximum number of clients that waited at the same time.
        self.requests = 0
        # `answered` is the time at which the last response was sent (s, time.monotonic()).
        self.answered = 0.0
        self._count, self._words, self._hold = count, words, hold
        self._inside = 0
        self._full = False
        self._changed = threading.Condition()

    def __call__(self, _: Message) -> dict[str, Json]:
        """Handle a request: wait for the other clients, and return the next text in the list."""
        with self._changed:
            word = self._words[self.requests % len(self._words)]
            success = self.requests > 0 or self._count == 1
            self.requests += 1
            self._inside += 1
            self.most = max(self.most, self._inside)
            self._full = self._full or self._inside >= self._count
            self._changed.notify_all()
            self._changed.wait_for(lambda: self._full, TOGETHER)
            self._full = True
        time.sleep(self._hold)
        with self._changed:
            self._inside -= 1
            self.answered = time.monotonic()
        return {"success": success, "message": word}


NOT_TOGETHER: Hints = [
    (
        1,
        (
            "The second call began after the first call had returned. Start all threads before you call "
            "join(), and write target=function, not target=function()."
        ),
    ),
    (
        ANYTHING,
        (
            "Some calls began only after other calls had returned. Use one thread for each call (a "
            "thread pool needs `count` threads), and start all threads before you wait for the first "
            "thread."
        ),
    ),
]
ERRORS = [
    (
        matches("TimesUp"),
        (
            "All calls have returned, but your function has not returned. Start each thread once, and "
            "then call join() once for each thread."
        ),
    ),
    (
        matches("cannot join thread before"),
        "Your function joined a thread before it started the thread. Call start() of each thread first.",
    ),
]


@part(
    "10.1",
    points=2,
    goal="Call a Trigger service from several threads at the same time, and return all messages.",
    needs=["call_at_once"],
    deadline=30.0,
)
def calls_at_once(context: CheckContext) -> None:
    """Run the student's function with few and with many clients; the server waits for all of their calls.

    In a run with one client, the call takes longer. Therefore, a function that uses join() with a short
    timeout returns too early. The run with few clients is the first, because a wrong answer may not end in
    the other runs.
    """
    context.prepare(KERNEL_CODE)
    context.run("proxy_watch.begin")
    try:
        few = context.random.integer(3, 4)
        slow = (1, context.random.number(SHORTEST, LONGEST))
        runs = [(few, 0.0), *context.random.shuffled([slow, (context.random.integer(24, 36), 0.0)])]
        earlier: list[str] = []
        late = max([_round(context, earlier, count, hold) for count, hold in runs])
        if late > PROMPT:
            _round(context, earlier, few, late + LONGER)
    finally:
        context.run("proxy_watch.end")


def _round(context: CheckContext, earlier: list[str], count: int, hold: float = 0.0) -> float:
    """Let the student's function make `count` calls that take `hold` s each.

    Return the time in s from the last response to the end of the function. `earlier` contains the messages
    of earlier runs; the function adds the messages of this run.
    """
    name = f"/{context.random.word()}"
    proxies = Proxies()
    context.place("checked_proxies", proxies)
    words = [context.random.word(8) for _ in range(count)]
    words[-1] = words[-2 % count]  # The last two responses contain the same message.
    gate = Gate(count, words, hold)
    server = context.serve(name, TRIGGER, gate)
    result = context.run("call_at_once", name, count, within=LIMIT + hold, hints=ERRORS)
    late = time.monotonic() - gate.answered
    if proxies.shared:  # If threads share a persistent proxy, the function may never return.
        _shares_no_proxy(context, proxies, server)
    found = result.returned()
    _called(context, count, gate)
    _calls_itself(context, server)
    _shares_no_proxy(context, proxies, server)
    _returned(context, words, found, earlier)
    earlier += words
    server.leave()
    return late


def _called(context: CheckContext, count: int, gate: Gate) -> None:
    # Threads that the function did not join may call the service after the function has returned.
    wait_until(lambda: gate.requests >= count, TOGETHER)
    context.expect(
        "the service is called `count` times",
        expected=count,
        actual=gate.requests,
        hints=[
            (
                0,
                (
                    "The service was not called. Call the service in each thread, and pass a tuple "
                    "such as (name,) as the argument `args` of Thread."
                ),
            ),
            (
                lambda actual: actual < count,
                "The service was called too few times. Start one thread for each call.",
            ),
            (ANYTHING, "The service was called too many times. Make exactly one call in each thread."),
        ],
    )
    context.expect(
        "all calls wait for their responses at the same time",
        expected=count,
        actual=gate.most,
        hints=NOT_TOGETHER,
    )


def _calls_itself(context: CheckContext, server: ScriptedServer) -> None:
    """Assert that the node of the notebook has made each call."""
    own = context.read("proxy_watch.caller")
    others = [caller for header in server.received.headers if (caller := header.get("callerid")) != own]
    context.require(
        "the service is called `count` times",
        holds=not others,
        expected=f"calls from the node {own}",
        actual=f"a call from the node {others[0]}" if others else "no other caller",
        hints=(
            "Another program called the service. Call the service with a rospy.ServiceProxy in each "
            "thread of your function."
        ),
    )


def _shares_no_proxy(context: CheckContext, proxies: Proxies, server: ScriptedServer) -> None:
    """Assert that no two threads use the same persistent proxy."""
    persistent = [header for header in server.received.headers if header.get("persistent") in ("1", "true")]
    context.require(
        "all calls wait for their responses at the same time",
        holds=not proxies.shared and len(persistent) <= proxies.calls,
        expected="a separate persistent proxy for each thread",
        actual="one persistent proxy for several threads",
        hints=SHARED,
    )


def _returned(context: CheckContext, words: list[str], found: Json, earlier: list[str]) -> None:
    items = found if isinstance(found, list) else []
    context.require(
        "call_at_once() returns a list with the message of each response",
        holds=isinstance(found, list) and sorted(map(str, items)) == sorted(words),
        expected=f"the message of each response, in any order; responses: {len(words)}",
        actual=found,
        hints=[
            (None, NO_RETURN),
            (
                lambda actual: isinstance(actual, list) and any(item in earlier for item in actual),
                "The list also contains messages of an earlier call of the function. Create a new list "
                "inside the function: a list as a default argument is created only once.",
            ),
            (
                lambda actual: isinstance(actual, list) and sorted(map(str, actual)) == sorted(set(words)),
                "Two clients got the same message, but the result contains this message only once. "
                "Append each message to a list, because a set and the keys of a dict contain each text "
                "only once.",
            ),
            (
                lambda actual: words[1:] and sorted(map(str, actual)) == sorted(words[1:]),
                "The message of a response with success=False is missing in the list. Append the message "
                "of each response, even if its field `success` is False.",
            ),
            (
                lambda actual: isinstance(actual, list) and len(actual) < len(words),
                "Not all messages are in the list. Before you return the list, call join() of every thread "
                "without a timeout.",
            ),
            (
                lambda actual: isinstance(actual[0], dict),
                (
                    "The list contains whole responses. Put only the field `message` of each response "
                    "into the list."
                ),
            ),
            (
                lambda actual: all(item is None for item in actual),
                (
                    "The list contains None. Append the field `message` of the response that the proxy "
                    "returned."
                ),
            ),
            (
                ANYTHING,
                (
                    "The list does not contain the right messages. Return a list that contains the "
                    "message of each response exactly once."
                ),
            ),
        ],
    )
