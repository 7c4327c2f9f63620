"""Every error that the course raises.

CourseError
├── SetupError: what the course needs is not there and could not be made
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
