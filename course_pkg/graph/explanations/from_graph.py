"""What is said when the master, a node or an address is not what it should be; rows as in from_handlers.

They stand before those of calls: `unable to contact master` is a failed call, too.
"""

from __future__ import annotations

from course_pkg.graph.explanations.from_handlers import Row

NO_MASTER = "No master answers at ROS_MASTER_URI."
MALFORMED = "ROS_MASTER_URI is not of the form http://HOST:PORT; most often http:// is missing."

FROM_GRAPH: tuple[Row, ...] = (
    (
        r"invalid master URI|MalformedMasterUri|ROS_MASTER_URI is '.{0,300}has to be of the form|"
        r"Unable to register with master node \[(?!http)",
        MALFORMED,
        "Write it whole, as in `export ROS_MASTER_URI=http://localhost:11311`, and start the program again.",
        "10",
    ),
    (
        r"Unable to register with master node",
        f"{NO_MASTER} init_node() tries on for ever, and says so only once.",
        "Start a master, or correct ROS_MASTER_URI. Ctrl-C ends the wait.",
        "10",
    ),
    (
        r"MasterSilent|takes connections and did not answer within|the master at \S+ does not answer",
        "The master takes connections and does not answer: it is stopped, or hangs.",
        "Let it go on (`kill -CONT` with its process id), or end it, start a new one and all nodes again.",
        "10",
    ),
    (
        r"NotAMaster|is not a ROS master",
        "Another program answers at the address where ROS_MASTER_URI has the master.",
        "Correct ROS_MASTER_URI, or unset it to have a master of your own.",
        "01",
    ),
    (
        r"unable to contact master|No ROS master at|Unable to communicate with master|MasterUnreachable|"
        r"master .{0,300}(?:not answer|unreachable)|^\s*(?:[\w.]+: )?ConnectionRefusedError|"
        r"^ERROR: unable to communicate with master",
        NO_MASTER,
        "Start a master, or correct ROS_MASTER_URI, and start the nodes again.",
        "10",
    ),
    (
        r"roscore cannot run as another roscore/master is already running",
        "A master runs on this port already; each computer needs only one.",
        "Use the master that runs. For a second one on purpose, take another port: `roscore -p 11312`.",
        "01",
    ),
    (
        r"\[Errno 98\]|Address already in use|PortBusy",
        "Another program has the port already. A rosmaster that prints this never ends by itself.",
        "End it with Ctrl-C, and look who has the port, for example with `ss -tlnp`; or take another port.",
        "01",
    ),
    (
        r"init_node\(\) has already been called with different arguments",
        "One program is one node: init_node() was called before, under another name or with other options.",
        "Keep the name, or restart the kernel. In the course's notebooks join() does all of it.",
        "02",
    ),
    (
        r"signal only works in main thread",
        "init_node() was called on a thread. The attempt has begun the node halfway and spoilt a second try.",
        "Restart the kernel, and call init_node() or join() in a cell of its own before starting threads.",
        "02",
    ),
    (
        r"new node registered with same name|NodeNameTaken",
        "Two nodes have one name. The master ends the older one as soon as the newer one registers.",
        "Give each node a name of its own: `__name:=other`, or init_node(…, anonymous=True).",
        "01",
    ),
    (
        r"ROSInterruptException|node shutdown interrupted|rospy has shut down|NotJoined",
        "This program's node was shut down: by Ctrl-C, by interrupting rospy.spin(), or by a namesake.",
        "Start the program again; in a notebook run the set-up cell with join() again, and never spin.",
        "10",
    ),
    (
        r"time is not initialized|ROSInitException",
        "rospy was asked for something that only a node can do, and this program is no node yet.",
        "Call init_node(), or join() in a notebook, before it.",
        "02",
    ),
    (
        r"topic types do not match",
        "Publisher and subscriber of one topic have different types. The subscriber hears nothing of it.",
        "Compare both with `rostopic info` and `rostopic type`, and use one type on both sides.",
        "02",
    ),
    (
        r"Name or service not known|Temporary failure in name resolution|Unknown host \[|"
        r"attempted to connect to non-local host",
        "The server registered under a host name that this machine cannot look up.",
        "Start the server with ROS_HOSTNAME=localhost.",
        "10",
    ),
)
