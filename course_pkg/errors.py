"""Every error that the course raises.

CourseError
├── SetupError: what the course needs is not there and could not be made
├── InterfaceError: a service or message type, or a value of one, is not what it should be
│   ├── UnknownType: no such type here
│   ├── BrokenDefinition: a .srv or .msg text that ROS refuses; with line and column
│   └── FieldError: a value that its field cannot hold; a ValueError, too
├── GraphError: the ROS graph is not as a call needs it
│   ├── MalformedMasterUri: ROS_MASTER_URI is not http://HOST:PORT
│   ├── MasterUnreachable: nobody takes connections at that address
│   ├── MasterSilent: somebody takes the connection and does not answer
│   ├── NotAMaster: somebody answers, and it is not a ROS master
│   ├── PortBusy: the port asked for belongs to another program
│   ├── NodeNameTaken: another living node has this name
│   ├── NotJoined: this kernel is no node, no longer, or not one that can do this
│   ├── NotAServiceType, NotAMessageType: another class was given in its place
│   ├── CallError: CallTimeout, CallCancelled, a call that brought no answer
│   ├── NothingHeard: fewer messages than asked for within the time
│   ├── NobodyListens: fewer subscribers than asked for within the time
│   ├── NotAdvertised: this publisher was stopped
│   ├── UnknownExecutable: no such package, or no such program in it
│   └── NodeFailed: the process of a node ended; holds the end of its output
├── ExamError: a check cannot be carried out
│   ├── UnknownCheck: no check has this id
│   ├── ToolMissing: this machine lacks what the part is built with; the student can do nothing in it yet
│   ├── LinkError: LinkBroken, LinkClosed, LinkSilent, between a kernel and its judge
│   └── AnswersBroken: the file of right and wrong answers cannot be read
├── CameraSilent: the camera of chapter 03's shop says nothing, so nobody can tell who is there
├── PrinterFailed: the printer of chapter 12's till has printed nothing
├── UnknownFault: the lab has no fault of this name
├── AuthoringError: a solution notebook cannot be taken as it is
├── GradingError: submissions cannot be graded as they are, or not here
│   ├── WallsMissing: this machine cannot keep a submission from the rest of it
│   └── WardFailed: the process that runs submissions ended, or never began
├── PanelError: a panel cannot do what a cell asked of it
│   ├── NothingPicked: no service, or none that has a form
│   ├── CallUnderWay: one call at a time
│   ├── DrawingFailed: graphviz did not lay the graph out
│   ├── PredictionsBroken: the file of predictions cannot be read
│   ├── NotASeries: what a plot was given cannot be drawn
│   ├── NotAChoice: a case expects what is no option, or stands there twice
│   ├── NotATopic: this cannot be the name of a topic
│   └── NotAnImage: what should be shown is no picture, or not one that can be shown
├── SiteError: the site cannot be built, or what was built is not as it should be
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

    def __init__(self, source: str, line: int, column: int, text: str, problem: str, remedy: str) -> None:
        # A tab is one column here, so that the mark stands below the right letter.
        shown = text.replace("\t", " ").rstrip()
        excerpt = f"\n    {shown}\n    {' ' * (column - 1)}^" if shown else ""
        super().__init__(f"{source}, line {line}, column {column}: {problem}; {remedy}{excerpt}")
        self.source = source
        self.line = line
        self.column = column
        self.text = text
        self.problem = problem
        self.remedy = remedy


class FieldError(InterfaceError, ValueError):
    """A value that a field cannot hold.

    `field` is the path to it (`points[2].x`), `value` is what was given,
    `allowed` is what would be right, `problem` is what is wrong, and `hint`,
    if not empty, is what was probably meant.
    """

    def __init__(self, field: str, value: object, allowed: str, problem: str = "", hint: str = "") -> None:
        where = f"{field}: " if field else ""
        wrong = problem or f"{value!r} does not fit"
        super().__init__(f"{where}{wrong}; expected {allowed}" + (f"; {hint}" if hint else ""))
        self.field = field
        self.value = value
        self.allowed = allowed
        self.problem = wrong
        self.hint = hint


class GraphError(CourseError):
    """The ROS graph is not as a call needs it."""


class MalformedMasterUri(GraphError):
    """ROS_MASTER_URI is not of the form http://HOST:PORT."""


class MasterUnreachable(GraphError):
    """Nobody takes connections at the address of the master."""


class MasterSilent(GraphError):
    """Somebody takes connections at the address of the master and does not answer in time."""


class NotAMaster(GraphError):
    """Somebody answers at the address of the master, and it is not a ROS master."""


class PortBusy(GraphError):
    """The port asked for belongs to another program."""


class NodeNameTaken(GraphError):
    """Another living node has this name."""


class NotJoined(GraphError):
    """This kernel is no node, no longer one, or one of another name."""


class NotAServiceType(GraphError, TypeError):
    """Something else was given where a service type belongs."""


class NotAMessageType(GraphError, TypeError):
    """Something else was given where a message type belongs."""


class CallError(GraphError):
    """A service call ended without an answer, and not by an error that rospy has words for."""


class CallTimeout(CallError):
    """The deadline of a service call passed."""


class CallCancelled(CallError):
    """A service call was cancelled."""


class NothingHeard(GraphError):
    """Fewer messages came than were asked for within the time."""


class NobodyListens(GraphError):
    """Fewer subscribers connected than were asked for within the time."""


class NotAdvertised(GraphError):
    """This publisher was stopped."""


class UnknownExecutable(GraphError):
    """No package of this name, or no program of this name in it."""


class NodeFailed(GraphError):
    """The process of a node ended; `output` is the end of what it printed, `returncode` its exit status."""

    def __init__(self, message: str, output: str = "", returncode: int | None = None) -> None:
        super().__init__(message)
        self.output = output
        self.returncode = returncode


class ExamError(CourseError):
    """A check cannot be carried out."""


class UnknownCheck(ExamError):
    """No check has this id."""


class ToolMissing(ExamError):
    """This machine lacks what a part is built with: it cannot be attempted here."""


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


class CameraSilent(CourseError):
    """The camera of a shop has said nothing for so long that nobody can tell who is at the counter."""


class PrinterFailed(CourseError):
    """The printer of a till has jammed or is out of paper, and has printed nothing."""


class UnknownFault(CourseError):
    """The lab has no fault of this name."""


class AuthoringError(CourseError):
    """A solution notebook cannot be taken as it is."""


class GradingError(CourseError):
    """Submissions cannot be graded as they are, or not here."""


class WallsMissing(GradingError):
    """This machine cannot keep a submission from the rest of it."""


class WardFailed(GradingError):
    """The process that runs submissions ended, or never began."""


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


class NotASeries(PanelError):
    """A plot was given what is no series of numbers."""


class NotAChoice(PanelError):
    """A case of choose() expects what is no option, or stands there twice."""


class NotATopic(PanelError):
    """This cannot be the name of a topic."""


class NotAnImage(PanelError, TypeError):
    """What should be shown is no sensor_msgs/Image, or not one that can be shown."""


class SiteError(CourseError):
    """The site cannot be built, or is not as it should be."""
