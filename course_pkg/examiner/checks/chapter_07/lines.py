"""07.4: a call as a line for a terminal, which bash splits and YAML reads."""

from __future__ import annotations

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.checks.chapter_07.questions import Question, questions
from course_pkg.examiner.checks.chapter_07.words import NO_RETURN
from course_pkg.examiner.ledger import hint_for
from course_pkg.examiner.scripted import ScriptedServer

SPLIT = (
    "The line came apart: bash splits it at blanks and takes quotes away. shlex.quote makes one word of a "
    "text, whatever is in it."
)
TYPES = (
    "YAML reads each value in its own way: off is False, 12 a number. json.dumps writes a dict so that YAML "
    "reads it back as it was."
)
TWICE = "It makes the call more than once."
COMPLAINTS = {
    says(
        r"call \S+ \w+:="
    ): "An argument with := in it is for ROS, which drops it here. Write the fields as a dict.",
    says(r"call \S+ \w+="): "To YAML, a=5 is a text. A dict is written {a: 5}.",
    says("^!"): "The ! belongs to the notebook. A terminal does without.",
    says("syntax error"): "In a terminal, blanks stand between the words, and no brackets around them.",
    says("no such file"): "The whole line became one word. Quote the fields, and nothing else.",
    says(r"\{.*no such option"): SPLIT,
    says(
        "no such option"
    ): "To rosservice, -5 looks like an option. Put -- before the values, or use a dict.",
    says("EOF while|unmatched|not found|ParserError|ScannerError|Not enough|Too many"): SPLIT,
    says("incorrect type|has no len"): TYPES,
    says("not available"): "Nobody serves that name. Put the name that is given into the line.",
    says("nothing was said"): "rosservice found no values behind the name. Give it the fields.",
}


@part(
    "07.4",
    points=2,
    goal="Return the line for a terminal that calls a service with these fields.",
    needs=["call_line"],
    deadline=38.0,
)
def type_the_call(exam: Exam) -> None:
    """Have bash run the lines, with values that a shell or YAML take for something else."""
    for question in questions(exam):
        name = f"/{exam.draw.word()}"
        server = exam.serve(name, question.kind, lambda _, answer=question.answer: answer)
        line = exam.run("call_line", name, question.fields).value
        exam.hold(
            "a text with rosservice call in it is returned",
            isinstance(line, str) and "rosservice call" in line,
            expected="a text such as 'rosservice call /name …'",
            seen=line,
            hints={
                None: NO_RETURN,
                (lambda seen: isinstance(seen, list)): "Return one text, as it is typed.",
                says("object|success"): "Return the line as a text. The check runs it.",
                says(""): "The tool is rosservice, and what it is told to do is call.",
            },
        )
        _typed(exam, question, server, line)


def _typed(exam: Exam, question: Question, server: ScriptedServer, line: str) -> None:
    """Hold that bash and rosservice make of the line one call that brings the fields."""
    done = exam.command("bash", "-c", line, within=12.0)
    said = f"{done.out}\n{done.err}".strip() or "nothing was said, and nothing was called"
    exam.hold(
        f"{question.what}: the line makes a call",
        done.status == 0 and len(server.requests) == 1,
        expected="one call, and no complaint",
        seen=_gist(said),
        hints=TWICE if len(server.requests) > 1 else hint_for(COMPLAINTS, f"{line}\n{said}"),
    )
    exam.expect(
        f"{question.what}: the fields arrive as they were given",
        expected=question.fields,
        seen=question.given(server.requests[0]),
        hints=[
            (
                question.mixed_up,
                "The values arrived in each other's fields: without names, the order is that of the type. "
                "Give names.",
            ),
            (says(""), TYPES),
        ],
    )


def _gist(said: str) -> str:
    """Return of what the tools said the lines that tell most: two from the first error, or the last one."""
    lines = said.splitlines()
    first = next((number for number, text in enumerate(lines) if says("^error|error:").search(text)), -1)
    return "\n".join(lines[first:][:2])
