"""07.1: all services of one type, found on the graph as it is."""

from __future__ import annotations

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.checks.chapter_07.words import NO_RETURN
from course_pkg.examiner.plain import Plain
from course_pkg.interfaces import compile_service

KINDS = ("std_srvs/Trigger", "std_srvs/SetBool", "course_pkg/AddTwoInts", "course_pkg/geometry")
DEAD = (
    "One service is listed and its server is gone, so nobody can be asked for its type. Catch "
    "rosservice.ROSServiceIOException around the question, inside the loop, and go on."
)
NONE = "None was found. Compare with the whole text that get_service_type returns, package/Type."
SOME = "Only some of them were found. Go through all names, and return after the loop."
GONE = "The error about the one that is gone ended the search. Catch it inside the loop, and go on."
LATE = "One has come since the function was called before. Ask the graph each time."
SLIPS = {
    says("ROSServiceIOException"): DEAD,
    says("Unable to load type"): "Not every type is built here, and its name is enough: get_service_type.",
    says("NoneType"): "get_service_type returns None for a name that nobody serves any more: skip it.",
}


@part(
    "07.1",
    points=2,
    goal="Return the names of all services of a type that are on the graph now.",
    needs=["services_of"],
    deadline=25.0,
)
def find_by_type(exam: Exam) -> None:
    """Serve some of two types, and of types named alike; then one more, and one whose server died."""
    kind, other = exam.draw.shuffled(KINDS)[:2]
    short = kind.partition("/")[2]
    word = exam.draw.word()
    mine = {f"/{word}/one", f"/{word}/{exam.draw.word()}"}
    for name in mine:
        exam.serve(name, kind, lambda _: {})
    misnamed = f"/{word}/{short}"  # after a type that it is not of
    exam.serve(misnamed, other, lambda _: {})
    for decoy in (f"{word}_pkg/{short}", f"{kind}Stamped"):
        made = compile_service(decoy, "---\nint32 found").cls
        exam.serve(f"/{word}/{exam.draw.word()}", made, lambda _: {})
    _found(exam, kind, SOME, mine)
    for place, hint in (("late", LATE), ("last", GONE)):
        if place == "last":
            exam.absent(f"/{word}/dead", stale=True)
        name = f"/{exam.draw.word()}/{place}"
        exam.serve(name, kind, lambda _: {})
        mine.add(name)
        _found(exam, kind, hint, mine)
    _found(exam, other, SOME, {misnamed})
    exam.expect(
        "an empty list for a type that nobody serves",
        expected=[],
        seen=exam.run("services_of", f"{word}_pkg/Nobodys", hints=SLIPS).value,
        hints={None: "Nobody serves that type. An empty list says so."},
    )


def _found(exam: Exam, kind: str, incomplete: str, mine: set[str]) -> None:
    """Hold that the function returns what is on the graph, and the check's own among it, `mine`.

    `incomplete` is the hint when some are missing.
    """
    names = exam.run("services_of", kind, hints=SLIPS).value
    _is_a_list_of_names(exam, names)
    there = {service.name: service.type for service in exam.look().services}
    right = mine | {name for name, its in there.items() if its == kind}  # who empties the graph finds none
    missing, extra = sorted(right.difference(names)), sorted(set(names) - right)
    exam.hold(
        "no other service is found",
        not extra,
        expected=f"a list without {', '.join(extra)}",
        seen=names,
        hints=_beside({there.get(name) for name in extra}, kind),
    )
    exam.hold(
        "every service of the type is found",
        not missing,
        expected=f"a list with {', '.join(missing)} in it",
        seen=names,
        hints=NONE if incomplete == SOME and right.isdisjoint(names) else incomplete,
    )
    exam.expect(
        "each is found once", expected=len(right), seen=len(names), hints="A name stands there twice."
    )


def _is_a_list_of_names(exam: Exam, names: Plain) -> None:
    exam.hold(
        "a list of names is returned",
        isinstance(names, list) and all(isinstance(name, str) for name in names),
        expected="a list of texts",
        seen=names,
        hints={
            None: NO_RETURN,
            (lambda seen: isinstance(seen, str)): "One text is no list. Collect the names in a list.",
            says("object"): "That is no list. list(...) or sorted(...) makes one.",
            says(""): "Return the names alone, without their nodes or types.",
        },
    )


def _beside(types: set[str | None], kind: str) -> str:
    """Return what to do about names that are of these types: None for no service, "" for a dead one."""
    if None in types:
        return "Those are no services. Return the names of the services that are of the type."
    if "" in types:
        return DEAD
    if f"{kind}Stamped" in types:
        return "That type only begins alike. Compare the whole text, by ==."
    if any(its and its.endswith(f"_pkg/{kind.partition('/')[2]}") for its in types):
        return "That type has the same name, and is from another package. Compare the whole text."
    return "Those are of another type. What a service is called does not tell its type: ask it."
