"""The table of common mistakes with ROS 1 services.

For each mistake, a row contains the names of the BreakIt faults or of the wrong builds that demonstrate the
mistake.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Shows:
    """The symptom of a fault.

    The client's output must contain `said`, and the server's output must contain `server`. If `hangs` is
    true, the client waits forever. The explanation from `explain` must contain `cause`; if `cause` is "",
    there is no explanation.
    """

    fault: str
    said: str = ""
    cause: str = ""
    server: str = ""
    hangs: bool = False


@dataclass(frozen=True)
class Builds:
    """A mistake that makes a build fail.

    `slip` is the name of the wrong build in test_mistakes.py. The build's output must contain `said`, and the
    explanation of this output must contain `cause`.
    """

    slip: str
    said: str
    cause: str


@dataclass(frozen=True)
class Row:
    """A row of the table: the section, the mistake, and its demonstrations (faults or builds)."""

    section: str
    slip: str
    shown: tuple[Shows | Builds, ...]


REPLY = "responded with an error: b"

BUILDING = (
    Row(
        "Building",
        "message_generation missing in find_package",
        (
            Builds(
                "no message_generation",
                'Unknown CMake command "add_service_files"',
                "message_generation defines this command",
            ),
        ),
    ),
    Row(
        "Building",
        "wrong order in CMakeLists.txt",
        (
            Builds(
                "generated too early",
                "generate_messages() must be called after add_service_files()",
                "comes after generate_messages",
            ),
            Builds(
                "generated too late",
                "generate_messages() must be called before catkin_package()",
                "generate_messages comes after catkin_package",
            ),
        ),
    ),
    Row(
        "Building",
        "generate_messages left commented",
        (
            Builds(
                "not generated", "No module named 'my_services'", "Python cannot find the package my_services"
            ),
        ),
    ),
    Row(
        "Building",
        "wrong file name",
        (Builds("wrong file", "service file not found", "The file Bocks.srv is not in the folder"),),
    ),
    Row(
        "Building",
        "- - - instead of ---",
        (Builds("blanks in the dashes", "Invalid declaration: - - -", "instead of the three dashes"),),
    ),
    Row(
        "Building",
        "not sourced",
        (
            Builds(
                "not sourced: Python", "No module named 'my_services'", "Python cannot find the package my_"
            ),
            Builds("not sourced: rospack", "[rospack] Error: package 'my_services' not found", "No package"),
        ),
    ),
    Row(
        "Building",
        "wrong case",
        (Builds("wrong case", "cannot import name 'box'", "does not contain box"),),
    ),
    Row(
        "Building",
        "another Python first on PATH",
        (
            Builds(
                "another Python",
                'import parse_package" failed',
                "The build uses the first Python on PATH",
            ),
        ),
    ),
    Row(
        "Building",
        "roslaunch instead of rosrun; rosservice show",
        (
            Builds("roslaunch for rosrun", "is neither a launch file in package", "roslaunch starts launch"),
            Builds("rosservice show", "Commands:", "does not know this command"),
        ),
    ),
    Row(
        "Building",
        "script that is not executable, or has no shebang",
        (
            Builds("no run bit", "Couldn't find executable named plain.py", "has no program plain.py"),
            Builds("no shebang", "command not found", "The shell executed the Python script"),
        ),
    ),
)

SERVING = (
    Row(
        "Serving",
        "handler returns None",
        (
            Shows(
                "returns_none",
                f"{REPLY}'service cannot process request: service handler returned None'",
                "reached its end without a return",
            ),
        ),
    ),
    Row(
        "Serving",
        "handler raises ValueError('boom')",
        (Shows("raises", "error processing request: ", "raised an exception", server="KeyError"),),
    ),
    Row(
        "Serving",
        "handler raises ServiceException('x')",
        (Shows("refuses", f"{REPLY}'service cannot process request: a person", "to refuse this request"),),
    ),
    Row(
        "Serving",
        "returns 42, text, or another response type",
        (
            Shows(
                "returns_number",
                "handler returned invalid value: Invalid number of arguments",
                "cannot create a response",
            ),
        ),
    ),
    Row(
        "Serving",
        "list or tuple of the wrong length; a list for one array field",
        (
            Shows(
                "wrong_length",
                "handler returned wrong number of values",
                "a list or tuple of the wrong length",
            ),
            Shows(
                "flat_list", "handler returned wrong number of values", "a list or tuple of the wrong length"
            ),
        ),
    ),
    Row(
        "Serving",
        "dict with a misspelt key",
        (Shows("dict_slip", "sucess is not an attribute of SetBoolResponse", "the response does not have"),),
    ),
    Row(
        "Serving",
        "value of the wrong type in a field",
        (
            Shows(
                "wrong_type",
                f"{REPLY}'error processing request: field success is not a bool'",
                "response has the wrong type",
            ),
        ),
    ),
    Row(
        "Serving",
        "wrong number of parameters",
        (Shows("wrong_arity", "takes 0 positional arguments but 1 was given", "has the wrong parameters"),),
    ),
    Row(
        "Serving",
        "handler sleeps for ever, or calls sys.exit, or gets KeyboardInterrupt",
        (
            Shows("sleeps", server="waiting for the hinge", hangs=True),
            Shows("exits", server="there is no door: leaving", hangs=True),
        ),
    ),
    Row(
        "Serving",
        "Request or Response class passed as the service type",
        (
            Shows(
                "request_for_type",
                server="has no attribute '_request_class'",
                cause="instead of the type of the service",
            ),
        ),
    ),
    Row(
        "Serving",
        "Service cell run twice",
        (
            Shows(
                "declared_twice",
                "not yet written",
                server="service [/lab/door] already registered",
                cause="the old handler still answers",
            ),
        ),
    ),
    Row(
        "Serving",
        "two nodes, one service name",
        (Shows("two_providers", "this is the wardrobe"),),
    ),
    Row(
        "Serving",
        "a lock held across a call to a service that needs it",
        (Shows("lock", server="calling the bolt\nthe bolt is called", hangs=True),),
    ),
)

CALLING = (
    Row(
        "Calling",
        "no such service",
        (Shows("no_service", "service [/lab/dor] unavailable", "No node provides"),),
    ),
    Row(
        "Calling",
        "wait_for_service() reaches its timeout",
        (
            Shows(
                "wait_in_vain",
                "ROSException: timeout exceeded while waiting for service /lab/door",
                "No node provided this service",
            ),
        ),
    ),
    Row(
        "Calling",
        "wait_for_service without a timeout",
        (
            Shows("wait_for_ever", hangs=True),
            Shows("zero_timeout", "ValueError: timeout must be non-zero", "a timeout above 0"),
        ),
    ),
    Row(
        "Calling",
        "too few or too many positional arguments",
        (Shows("too_few", "TypeError: Invalid number of arguments", "differs from the number of fields"),),
    ),
    Row(
        "Calling",
        "positional and keyword mixed",
        (
            Shows(
                "mixed",
                "publish() can be called with arguments or keywords, but not both.",
                "some values by position",
            ),
        ),
    ),
    Row(
        "Calling",
        "keyword misspelt",
        (
            Shows(
                "misspelt",
                "AttributeError: dat is not an attribute of SetBoolRequest",
                "the request does not have",
            ),
        ),
    ),
    Row("Calling", "keyword left out, or None", (Shows("left_out", 'message: "shut"'),)),
    Row(
        "Calling",
        "wrong type of value",
        (Shows("wrong_value", "genpy.message.SerializationError: field data", "wrong type for its field"),),
    ),
    Row(
        "Calling",
        "definitions differ",
        (Shows("md5", "md5sums do not match", "different definitions"),),
    ),
    Row(
        "Calling",
        "server killed, registration stale",
        (
            Shows(
                "stale",
                "unable to connect to service: [Errno 111] Connection refused",
                "still lists a server",
            ),
        ),
    ),
    Row(
        "Calling",
        "server dies during the call",
        (
            Shows(
                "died",
                "transport error completing service call: unable to receive data from sender",
                "ended during the call",
            ),
        ),
    ),
    Row(
        "Calling",
        "server stopped (SIGSTOP), or blocked by an idle connection",
        (Shows("stopped", hangs=True), Shows("hogged", hangs=True)),
    ),
    Row(
        "Calling",
        "persistent proxy after the server died",
        (
            Shows(
                "persistent",
                "TransportTerminated: 32Broken pipe",
                "The server of a persistent proxy has ended",
            ),
        ),
    ),
    Row(
        "Calling",
        "bad ROS_HOSTNAME on the server",
        (Shows("hostname", "Name or service not known", "a host name that this machine does not know"),),
    ),
    Row(
        "Calling",
        "proxy shared between threads",
        (Shows("shared_proxy", "went to another thread or got lost: True"),),
    ),
)

NODES_AND_MASTERS = (
    Row(
        "Nodes and masters",
        "no master",
        (
            Shows("no_master", "Unable to register with master node", "No master answers", hangs=True),
            Shows("no_master_call", "unable to contact master", "No master answers"),
            Shows("no_master_param", "ConnectionRefusedError", "No master answers"),
        ),
    ),
    Row(
        "Nodes and masters",
        "master restarted",
        (Shows("restarted_master", "service [/lab/door] unavailable", "No node provides"),),
    ),
    Row("Nodes and masters", "master hung", (Shows("hung_master", hangs=True),)),
    Row(
        "Nodes and masters",
        "init_node again with other arguments",
        (
            Shows(
                "init_again",
                "rospy.init_node() has already been called with different arguments",
                "One program can be only one node",
            ),
        ),
    ),
    Row(
        "Nodes and masters",
        "init_node on a thread",
        (Shows("init_on_thread", "signal only works in main thread", "called outside the main thread"),),
    ),
    Row(
        "Nodes and masters",
        "rospy.spin() in a cell, then Interrupt",
        (Shows("spun", "service [/lab/door] unavailable", "No node provides", server="the door is served"),),
    ),
    Row(
        "Nodes and masters",
        "two kernels, one node name",
        (Shows("same_name", server="new node registered with same name", cause="have the same name"),),
    ),
    Row(
        "Nodes and masters",
        "node killed by SIGKILL",
        (Shows("killed", "ERROR: connection refused to [", "killed and could not unregister"),),
    ),
    Row(
        "Nodes and masters",
        "port taken: roscore",
        (
            Shows(
                "port_taken",
                "roscore cannot run as another roscore/master is already running",
                "A master already runs on this port",
            ),
        ),
    ),
    Row(
        "Nodes and masters",
        "port taken: rosmaster",
        (Shows("port_taken_rosmaster", "OSError: [Errno 98]", "already uses the port", hangs=True),),
    ),
    Row(
        "Nodes and masters",
        "URI malformed",
        (
            Shows(
                "malformed_uri",
                "Unable to register with master node [localhost:",
                "http:// is missing",
                hangs=True,
            ),
            Shows("malformed_uri_call", "ValueError: invalid master URI", "http:// is missing"),
        ),
    ),
    Row(
        "Nodes and masters",
        "first message published at once",
        (Shows("first_message", "the keeper heard 0"),),
    ),
    Row(
        "Nodes and masters",
        "topic types differ",
        (Shows("topic_types", "published 10, the keeper heard 0"),),
    ),
    Row(
        "Nodes and masters",
        "print in a callback",
        (Shows("print_in_callback", "below cell 2: ['heard: ring'"),),
    ),
)

ROWS = (*BUILDING, *SERVING, *CALLING, *NODES_AND_MASTERS)
# The expected number of rows in each section of the table.
COUNTS = {"Building": 10, "Serving": 13, "Calling": 15, "Nodes and masters": 14}
