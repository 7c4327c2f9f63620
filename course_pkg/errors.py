"""Every error that the course raises.

CourseError
├── SetupError: something that the course needs is missing and could not be created
├── InterfaceError: a type is unknown or wrong, or a value does not fit its field
│   ├── UnknownType: there is no such type
│   ├── BrokenDefinition: a .srv or .msg text that ROS does not accept; with line and column
│   └── FieldError: a value that its field cannot hold; also a ValueError
├── GraphError: a problem with the ROS graph
│   ├── MalformedMasterUri: ROS_MASTER_URI is not http://HOST:PORT
│   ├── MasterUnreachable: no program accepts connections at that address
│   ├── MasterSilent: a program accepts the connection, but does not answer
│   ├── NotAMaster: the program that answers is not a ROS master
│   ├── PortBusy: another program uses the port
│   ├── NodeNameTaken: another running node has this name
│   ├── NotJoined: this kernel is not a node, or is the wrong kind of node
│   ├── NotAServiceType, NotAMessageType: the argument is not a service or message type
│   ├── CallError: CallTimeout, CallCancelled: a call ended without a response
│   ├── NothingHeard: too few messages within the time limit
│   ├── PublisherStopped: this publisher was stopped
│   ├── UnknownExecutable: no such package, or no such program or launch file in it
│   └── NodeFailed: the process of a node ended; contains the end of its output
├── ChannelError: ChannelBroken, ChannelClosed, ChannelTimeout: a channel between two processes failed
├── CheckError: a check cannot run
│   ├── UnknownCheck: no check has this id
│   └── ToolMissing: this machine lacks a tool that the exercise needs
├── CameraSilent: the camera of the shop sends no messages
├── PrinterFailed: the printer of the cash register has printed nothing
├── UnknownFault: BreakIt has no fault of this name
├── AuthoringError: a solution notebook breaks a rule of the course
├── GradingError: submissions cannot be graded
│   ├── SandboxUnavailable: this machine cannot isolate a submission
│   └── WorkerFailed: the process that runs submissions ended, or did not start
├── ClassViewError: the class view cannot start, or its data cannot be used
├── HandoutError: an edition for students cannot be made, or work cannot be collected
├── HubError: a JupyterHub for a class cannot be set up
├── PanelError: a panel cannot do what a cell asks for
│   ├── NoServiceSelected: no service is selected, or the selected service has no form
│   ├── CallInProgress: the panel is already making a call
│   ├── DrawingFailed: graphviz failed
│   ├── InvalidPredictions: the file of predictions cannot be read
│   ├── NotAChoice: the arguments of choose() are invalid
│   └── NotATopic: the string cannot be the name of a topic
├── ExportFailed: a file with the student's progress cannot be written
└── SiteError: the site cannot be built, or a check of the built site failed

Each error message explains what happened, where, and what to do next.
"""

from __future__ import annotations


class CourseError(Exception):
    """The base class: `except CourseError` catches all errors of the course."""


class SetupError(CourseError):
    """Something that the course needs is missing, and the course could not create it."""


class InterfaceError(CourseError):
    """A service or message type is unknown or wrong, or a value does not fit its field."""


class UnknownType(InterfaceError):
    """There is no service or message type with this `name`."""

    def __init__(self, name: str, message: str) -> None:
        super().__init__(message)
        self.name = name


class BrokenDefinition(InterfaceError):
    """ROS does not accept the text of a service or message type.

    `source` is the name of the type or of the file. `line` and `column` count from 1. `text` is the line with
    the error. `problem` and `remedy` are the two parts of the message.
    """

    def __init__(self, source: str, line: int, column: int, text: str, problem: str, remedy: str) -> None:
        # One space replaces each tab, so the character ^ in the message is below the error.
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

    `field` is the path of the field (`points[2].x`), and `value` is the given value. `allowed` describes the
    valid values, and `problem` says what is wrong. `hint` may name the value that was probably meant.
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
    """A problem with the ROS graph."""


class MalformedMasterUri(GraphError):
    """ROS_MASTER_URI is not of the form http://HOST:PORT."""


class MasterUnreachable(GraphError):
    """No program accepts connections at the address of the master."""


class MasterSilent(GraphError):
    """A program accepts connections at the address of the master, but does not answer in time."""


class NotAMaster(GraphError):
    """The program that answers at the address of the master is not a ROS master."""


class PortBusy(GraphError):
    """Another program uses the port."""


class NodeNameTaken(GraphError):
    """Another running node has this name."""


class NotJoined(GraphError):
    """This kernel is not a node, is no longer a node, or is a node with another name than requested."""


class NotAServiceType(GraphError, TypeError):
    """The argument must be a service type, but is not."""


class NotAMessageType(GraphError, TypeError):
    """The argument must be a message type, but is not."""


class CallError(GraphError):
    """A service call ended without a response, in a way for which rospy has no exception."""


class CallTimeout(CallError):
    """A service call reached its deadline."""


class CallCancelled(CallError):
    """A service call was cancelled."""


class NothingHeard(GraphError):
    """Fewer messages than requested arrived within the time limit."""


class PublisherStopped(GraphError):
    """This publisher was stopped."""


class UnknownExecutable(GraphError):
    """There is no package with this name, or the package has no such program or launch file."""


class NodeFailed(GraphError):
    """The process of a node ended.

    `output` is the end of the process's output, and `returncode` is the exit status of the process.
    """

    def __init__(self, message: str, output: str = "", returncode: int | None = None) -> None:
        super().__init__(message)
        self.output = output
        self.returncode = returncode


class ChannelError(CourseError):
    """The channel between two processes of the course failed."""


class ChannelBroken(ChannelError):
    """A message on the channel violates the protocol."""


class ChannelClosed(ChannelError):
    """The other process has closed the channel."""


class ChannelTimeout(ChannelError):
    """The other process did not read or respond in time."""


class CheckError(CourseError):
    """A check cannot run."""


class UnknownCheck(CheckError):
    """No check has this id."""


class ToolMissing(CheckError):
    """This machine lacks a tool that an exercise needs."""


class CameraSilent(CourseError):
    """The camera of a shop sends no messages.

    Therefore, it is unknown whether a customer is at the counter.
    """


class PrinterFailed(CourseError):
    """The printer of a cash register has a paper jam or has no paper, and has printed nothing."""


class UnknownFault(CourseError):
    """BreakIt has no fault of this name."""


class AuthoringError(CourseError):
    """A solution notebook breaks a rule of the course."""


class GradingError(CourseError):
    """Submissions cannot be graded."""


class ClassViewError(CourseError):
    """The class view cannot start, or its data cannot be used."""


class SandboxUnavailable(GradingError):
    """This machine cannot isolate a submission."""


class WorkerFailed(GradingError):
    """The process that runs submissions ended, or did not start."""


class HandoutError(CourseError):
    """An edition for students cannot be made, or students' work cannot be collected."""


class HubError(CourseError):
    """A JupyterHub for a class cannot be set up, or a student's server cannot start."""


class PanelError(CourseError):
    """A panel cannot do what a cell asks for."""


class NoServiceSelected(PanelError):
    """No service is selected, or the selected service has no form."""


class CallInProgress(PanelError):
    """The panel is already making a call, and it makes only one call at a time."""


class DrawingFailed(PanelError):
    """Graphviz is missing, or it could not draw the graph."""


class InvalidPredictions(PanelError):
    """The file of predictions cannot be read."""


class NotAChoice(PanelError):
    """A case of choose() expects an option that does not exist, or two cases in the list are equal."""


class NotATopic(PanelError):
    """The string cannot be the name of a topic."""


class ExportFailed(CourseError):
    """A file with the student's progress cannot be written."""


class SiteError(CourseError):
    """The site cannot be built, or a check of the built site failed."""
