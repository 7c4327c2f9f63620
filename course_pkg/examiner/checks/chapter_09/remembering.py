"""09.6: a client that needs the master once."""

from __future__ import annotations

from typing import Any

from course_pkg.examiner import Exam, Refuse, part, says
from course_pkg.examiner.checks.chapter_09.clients import GEOMETRY, Client
from course_pkg.examiner.scripted import Act


@part(
    "09.6",
    points=2,
    goal="Look the address up once and go on with it; look again only when nobody is there any more.",
    needs=["Remembering"],
    deadline=20.0,
)
def an_address_that_is_kept(exam: Exam) -> None:
    """Call; have the master forget; refuse; move the server."""
    name = f"/{exam.draw.word()}"
    numbers = [exam.draw.numbers(2, 10.0, 90.0) for _ in range(3)]
    answers: list[Act] = [dict(zip(("area", "volume"), each, strict=True)) for each in numbers]
    acts = [answers[0], answers[1], answers[1], Refuse("not this box")]
    server = exam.serve(name, GEOMETRY, lambda _: acts.pop(0) if acts[1:] else acts[0])
    client = Client(exam, "Remembering", name)
    _measures(exam, client, "area and volume are returned", numbers[0], {})
    exam.absent(name)
    lost = {
        says("unknown service|no provider|Master|unavailable"): (
            "It looked up again, and the master does not know. It had the address from the call before."
        )
    }
    _measures(exam, client, "a call needs no master when the address is known", numbers[1], lost)
    _not_led_astray(exam, name, client, numbers[1])
    before = len(server.requests)
    client.measure({}).raised(
        "a refusal comes out",
        "ServiceException",
        saying="not this box",
        hints="The server was there, and said no. Look up again only if nobody is there: OSError.",
    )
    exam.expect(
        "a refusal is not asked again",
        expected=1,
        seen=len(server.requests) - before,
        hints="It asked twice. Only an OSError means that nobody is at the address.",
    )
    server.leave()
    exam.serve(name, GEOMETRY, lambda _: answers[2])
    moved = {
        says("refused|OSError|Connection"): (
            "Nobody is at the old address any more. Catch the OSError, look up again, and ask there."
        )
    }
    _measures(exam, client, "a server that moved is found again", numbers[2], moved)
    exam.absent(name)
    kept = {says(""): "Keep what the second look-up said."}
    _measures(exam, client, "the new address is kept, too", numbers[2], kept)


def _not_led_astray(exam: Exam, name: str, client: Client, numbers: list[float]) -> None:
    """Have the master name another server meanwhile: who asks the master again goes there."""
    wrong = exam.draw.numbers(2, 100.0, 900.0)
    other = exam.serve(name, GEOMETRY, lambda _: dict(zip(("area", "volume"), wrong, strict=True)))
    again = "It looked up again, and the address that it had was good. Ask there first."
    _measures(exam, client, "a call needs no master when the address is known", numbers, {}, again)
    other.leave()


def _measures(
    exam: Exam,
    client: Client,
    rule: str,
    numbers: list[float],
    hints: dict[Any, str],
    other: str = "Return what ask returned.",
) -> None:
    exam.expect(
        rule,
        expected=numbers,
        seen=client.measure(hints).value,
        near=1e-6,
        hints={
            None: "Nothing was returned: return what ask returned.",
            says(""): other,
        },
    )
