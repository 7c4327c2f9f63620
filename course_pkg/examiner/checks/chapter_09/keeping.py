"""09.5: a client that keeps its connection, and makes a new one when it breaks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from course_pkg.examiner import Exam, HangUp, Its, Refuse, part, says
from course_pkg.examiner.outcome import Outcome
from course_pkg.examiner.plain import Plain
from course_pkg.examiner.scripted import Act, ScriptedServer

GEOMETRY = "course_pkg/geometry"
A_CLIENT = """
def begin(kind, service):
    global client
    client = kind(service)


def measured(kind, *sides):
    answer = client.measure(*sides)
    return getattr(answer, "volume", answer)
"""
MADE = "Keeper(service)"
MEASURE = "measure(length, width, height)"
BROKEN = {
    says("transport error"): (
        "The connection broke, and the error came out. Catch it, make a new proxy (the old one stays broken) "
        "and ask once more."
    ),
    says("TransportTerminated|NoneType|AttributeError"): (
        "It asks on over the connection that is gone. Close that proxy, and make a new one."
    ),
    says(
        "^TimesUp"
    ): "It never ends. Ask once more over the new connection, and let an error there come out.",
    says("unavailable"): "A server has come back under this name: look it up again with a new proxy.",
}


@part(
    "09.5",
    points=3,
    goal="Keep one connection for all calls; when it breaks, make a new one and ask once more.",
    needs=["Keeper"],
    deadline=20.0,
)
def a_connection_that_comes_back(exam: Exam) -> None:
    """Several calls; a refusal; a connection that breaks; a server that moves; a server that is gone."""
    name = f"/{exam.draw.word()}"
    volumes = exam.draw.numbers(8, 10.0, 90.0)
    acts: list[Act] = [{"volume": each} for each in volumes[:5]]
    server = exam.serve(name, GEOMETRY, lambda _: acts[0] if isinstance(acts[0], Refuse) else acts.pop(0))
    exam.prepare(A_CLIENT)
    exam.hold("a client can be made", exam.run("begin", Its("Keeper"), name, worded=MADE).value is None)
    for volume in volumes[:3]:
        _measures(exam, "the service's answer is returned", volume)
    _one_connection(exam, server, "the calls share one connection", 1)
    acts.insert(0, Refuse("not this box"))
    _refused(exam, server)
    acts.pop(0)
    _measures(exam, "the connection serves on after a refusal", volumes[3])
    _one_connection(exam, server, "a refusal is no reason to connect anew", 1)
    acts.insert(0, HangUp())
    _measures(exam, "a broken connection is made anew", volumes[4])
    acts.append(HangUp())
    server.leave()
    _gone(exam)
    moved = exam.serve(name, GEOMETRY, lambda _: {"volume": volumes[5]})
    _measures(exam, "a server that came back is found again", volumes[5])
    _measures(exam, "a server that came back is found again", volumes[5])
    _one_connection(exam, moved, "the new connection is kept, too", 1)


def _measure(exam: Exam, within: float = 3.0, hints: Mapping[Any, str] = BROKEN) -> Outcome:
    sides = exam.draw.numbers(3, 0.5, 9.0)
    return exam.run("measured", Its("Keeper"), *sides, within=within, hints=hints, worded=MEASURE)


def _measures(exam: Exam, rule: str, volume: Plain) -> None:
    exam.expect(
        rule,
        expected=volume,
        seen=_measure(exam).value,
        near=1e-6,
        hints={None: "Nothing was returned: return what the proxy returned."},
    )


def _one_connection(exam: Exam, server: ScriptedServer, rule: str, most: int) -> None:
    seen = len(server.seen.headers)
    kept = all(header.get("persistent") == "1" for header in server.seen.headers)
    exam.hold(
        rule,
        seen == most and kept,
        expected=f"{most} connection, opened with persistent=1",
        seen=f"{seen}, opened {'with' if kept else 'without'} persistent=1",
        hints=[
            (
                (lambda words: "without" in words),
                "Make the proxy with persistent=True, once, and keep it in self.",
            ),
            (says(""), "A new connection for each call is what this was to avoid. Keep the proxy in self."),
        ],
    )


def _refused(exam: Exam, server: ScriptedServer) -> None:
    before = len(server.requests)
    _measure(exam).raised(
        "a refusal comes out",
        "ServiceException",
        saying="not this box",
        hints="The server answered, with a reason: whoever called has to hear it.",
    )
    exam.expect(
        "a refusal is not asked again",
        expected=1,
        seen=len(server.requests) - before,
        hints="The connection was well, and the answer was no. Ask again only if the connection broke.",
    )


def _gone(exam: Exam) -> None:
    outcome = _measure(exam, hints={})
    exam.hold(
        "a server that is gone is an error",
        bool(outcome.error),
        expected="a ServiceException",
        seen=outcome.error or "a value",
        hints="Nobody serves the name, so nothing could be measured. Let the second error come out.",
    )
    exam.hold(
        "it is said soon",
        not outcome.error.startswith("TimesUp"),
        expected="an error at once",
        seen=outcome.error,
        hints="It goes on for ever. Ask once more, and not until it works.",
    )
