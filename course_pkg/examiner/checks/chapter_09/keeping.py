"""09.5: a client that keeps its connection, and makes a new one when it breaks."""

from __future__ import annotations

from course_pkg.examiner import Exam, HangUp, Refuse, part, says
from course_pkg.examiner.checks.chapter_09.clients import GEOMETRY, Client
from course_pkg.examiner.plain import Plain
from course_pkg.examiner.scripted import Act, ScriptedServer

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
    """Answer; refuse; break the connection; leave with the server; come back elsewhere."""
    name = f"/{exam.draw.word()}"
    volumes = exam.draw.numbers(8, 10.0, 90.0)
    acts: list[Act] = [{"volume": each} for each in volumes[:5]]
    server = exam.serve(name, GEOMETRY, lambda _: _next(acts))
    client = Client(exam, "Keeper", name)
    for volume in volumes[:3]:
        _measures(exam, client, "the service's answer is returned", volume)
    _one_connection(exam, server, "the calls share one connection")
    acts.insert(0, Refuse("not this box"))
    _refused(exam, client, server)
    acts.pop(0)
    _measures(exam, client, "the connection serves on after a refusal", volumes[3])
    _one_connection(exam, server, "a refusal is no reason to connect anew")
    acts.insert(0, HangUp())
    _measures(exam, client, "a broken connection is made anew", volumes[4])
    _broken_again(exam, client, server)
    acts.append({"volume": volumes[6]})
    _measures(exam, client, "a broken connection is made anew", volumes[6])
    server.leave()
    _gone(exam, client)
    moved = exam.serve(name, GEOMETRY, lambda _: {"volume": volumes[5]})
    _measures(exam, client, "a server that came back is found again", volumes[5])
    _measures(exam, client, "a server that came back is found again", volumes[5])
    _one_connection(exam, moved, "the new connection is kept, too")


def _next(acts: list[Act]) -> Act:
    """Return what to do now: a refusal stays until it is taken away, and in the end the connection breaks."""
    if not acts:
        return HangUp()
    return acts[0] if isinstance(acts[0], Refuse) else acts.pop(0)


def _measures(exam: Exam, client: Client, rule: str, volume: Plain) -> None:
    exam.expect(
        rule,
        expected=volume,
        seen=client.measure(BROKEN).value,
        near=1e-6,
        hints={None: "Nothing was returned: return what the proxy returned."},
    )


def _one_connection(exam: Exam, server: ScriptedServer, rule: str) -> None:
    seen = len(server.seen.headers)
    kept = all(header.get("persistent") == "1" for header in server.seen.headers)
    exam.hold(
        rule,
        seen == 1 and kept,
        expected="1 connection, opened with persistent=1",
        seen=f"{seen}, opened {'with' if kept else 'without'} persistent=1",
        hints=[
            (
                (lambda words: "without" in words),
                "Make the proxy with persistent=True, once, and keep it in self.",
            ),
            (says(""), "A new connection for each call is what this was to avoid. Keep the proxy in self."),
        ],
    )


def _refused(exam: Exam, client: Client, server: ScriptedServer) -> None:
    before = len(server.requests)
    client.measure(BROKEN).raised(
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


def _broken_again(exam: Exam, client: Client, server: ScriptedServer) -> None:
    """Break the connection, and the one that is made after it, and whatever comes then."""
    before = len(server.requests)
    outcome = client.measure(BROKEN)
    asked = len(server.requests) - before
    exam.hold(
        "a broken connection is made anew",
        asked == 2 and bool(outcome.error) and not outcome.error.startswith("TimesUp"),
        expected="2 requests, and an error where the second connection broke, too",
        seen=f"{asked}, and {outcome.error or 'a value'}",
        hints=[
            ((lambda _: asked > 2), "It asked again and again. Ask once more, and not until it works."),
            (
                (lambda _: asked < 2),
                "The proxy that was made after the last break was not kept in self, or it was not asked.",
            ),
            (says(""), "Nothing was measured: let the second error come out."),
        ],
    )


def _gone(exam: Exam, client: Client) -> None:
    outcome = client.measure({})
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
