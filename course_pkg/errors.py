"""Every error that the course raises.

CourseError
├── SetupError: what the course needs is not there and could not be made
├── InterfaceError: a service or message type, or a value of one, is not what it should be
│   ├── UnknownType: no such type here
│   ├── BrokenDefinition: a .srv or .msg text that ROS refuses; with line and column
│   └── FieldError: a value that its field cannot hold; a ValueError, too
├── ExamError: a check cannot be carried out
│   ├── UnknownCheck: no check has this id
│   ├── LinkError: LinkBroken, LinkClosed, LinkSilent, between a kernel and its judge
│   └── AnswersBroken: the file of right and wrong answers cannot be read
├── AuthoringError: a solution notebook cannot be taken as it is
├── PanelError: a panel cannot do what a cell asked of it
│   ├── NothingPicked: no service, or none that has a form
│   ├── CallUnderWay: one call at a time
│   ├── DrawingFailed: graphviz did not lay the graph out
│   └── PredictionsBroken: the file of predictions cannot be read
└── (each subpackage adds its branch below, and to this picture)

A message says what happened, where, and what to do next.
"""

from __future__ import annotations


class CourseError(Exception):
    """The root: `except CourseError` catches whatever the course itself raises."""


class SetupError(CourseError):
    """What the course needs is not there and could not be made."""


class InterfaceError(CourseError):
    """A service or message type, or a value of one, is not what it should be."""


class UnknownType(InterfaceError):
    """No service or message type has this `name` here."""

    def __init__(self, name: str, message: str) -> None:
        super().__init__(message)
        self.name = name


class BrokenDefinition(InterfaceError):
    """The text of a service or message type is not what ROS accepts.

    `source` names the type or file, `line` and `column` count from 1, `text` is
    the offending line, `problem` and `remedy` are two halves of a sentence.
    """

    def __init__(
        self, source: str, line: int, column: int, text: str, problem: str, remedy: str
    ) -> None:
        # A tab is one column here, so that the mark stands below the right letter.
        shown = text.replace("\t", " ").rstrip()
        mark = " " * (column - 1) + "^"
        super().__init__(
            f"{source}, line {line}, column {column}: {problem}; {remedy}\n    {shown}\n    {mark}"
        )
        self.source = source
        self.line = line
        self.column = column
        self.text = text
        self.problem = problem
        self.remedy = remedy


class FieldError(InterfaceError, ValueError):
    """A value that a field cannot hold.

    `field` is the path to it (`points[2].x`), `value` is what was given,
    `problem` is what is wrong with it, `allowed` is what would be right.
    """

    def __init__(self, field: str, value: object, problem: str, allowed: str) -> None:
        super().__init__(f"{field}: {problem}; {allowed}" if field else f"{problem}; {allowed}")
        self.field = field
        self.value = value
        self.problem = problem
        self.allowed = allowed


class ExamError(CourseError):
    """A check cannot be carried out."""


class UnknownCheck(ExamError):
    """No check has this id."""


class LinkError(ExamError):
    """The link between a kernel and its judge failed."""


class LinkBroken(LinkError):
    """A message on the link is not what the protocol allows."""


class LinkClosed(LinkError):
    """The other end of the link is gone."""


class LinkSilent(LinkError):
    """The other end of the link did not answer in time."""


class AnswersBroken(ExamError):
    """The file of right and wrong answers cannot be read."""


class AuthoringError(CourseError):
    """A solution notebook cannot be taken as it is."""


class PanelError(CourseError):
    """A panel cannot do what a cell asked of it."""


class NothingPicked(PanelError):
    """No service is picked, or what is picked has no form."""


class CallUnderWay(PanelError):
    """The panel is calling already; it makes one call at a time."""


class DrawingFailed(PanelError):
    """Graphviz is missing or did not lay the graph out."""


class PredictionsBroken(PanelError):
    """The file of predictions cannot be read."""
