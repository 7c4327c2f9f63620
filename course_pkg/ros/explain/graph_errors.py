"""The table of errors of the master, nodes and addresses; the module `handler_errors` explains the columns.

A failed call may also report `unable to contact master`. Therefore, this table is searched before the table
for calls.
"""

from __future__ import annotations

from course_pkg.ros.explain.handler_errors import Row

NO_MASTER = "No master answers at ROS_MASTER_URI."
MALFORMED = "ROS_MASTER_URI does not have the form http://HOST:PORT. Usually http:// is missing."

FROM_GRAPH: tuple[Row, ...] = (
    (
        r"invalid master URI|MalformedMasterUri|ROS_MASTER_URI is '.{0,300}has to be of the form|"
        r"Unable to register with master node \[(?!http)",
        MALFORMED,
        "Write the whole address: `export ROS_MASTER_URI=http://localhost:11311`. Start the program again.",
        "12",
    ),
    (
        r"Unable to register with master node",
        f"{NO_MASTER} init_node() tries to register the node repeatedly, but prints this message only once.",
        "Start a master, or correct ROS_MASTER_URI. Ctrl-C ends the waiting program.",
        "12",
    ),
    (
        r"MasterSilent|accepts connections, but did not answer within|the master at \S+ does not answer",
        "The master accepts connections, but does not answer. The master's process is paused or blocked.",
        (
            "If the process of the master is paused, resume this process with `kill -CONT`. "
            "Otherwise, restart the master and all nodes."
        ),
        "12",
    ),
    (
        r"NotAMaster|is not a ROS master",
        "The program at the address in ROS_MASTER_URI is not a master.",
        "Correct ROS_MASTER_URI, or unset it to get your own master.",
        "01",
    ),
    (
        r"unable to contact master|No ROS master at|Unable to communicate with master|MasterUnreachable|"
        r"master .{0,300}(?:not answer|unreachable)|^\s*(?:[\w.]+: )?ConnectionRefusedError|"
        r"^ERROR: unable to communicate with master",
        NO_MASTER,
        "Start a master, or correct ROS_MASTER_URI, and start the nodes again.",
        "12",
    ),
    (
        r"roscore cannot run as another roscore/master is already running",
        "A master already runs on this port, and each computer needs only one master.",
        "Use the running master. If you need a second master, use a different port: `roscore -p 11312`.",
        "01",
    ),
    (
        r"\[Errno 98\]|Address already in use|PortBusy",
        "Another program already uses the port. After this error, a rosmaster continues to "
        "run, but nodes cannot connect to it.",
        "End rosmaster with Ctrl-C. Find the other program with `ss -tlnp`, or use a different port.",
        "01",
    ),
    (
        r"init_node\(\) has already been called with different arguments",
        "The program called init_node() before, with a different name or different options. "
        "One program can be only one node.",
        "Use the same name again, or restart the kernel. In the course's notebooks, join() "
        "calls init_node().",
        "02",
    ),
    (
        r"signal only works in main thread",
        (
            "init_node() was called outside the main thread. The call did not finish, and a "
            "second call does not work."
        ),
        "Restart the kernel, and call init_node() or join() in a separate cell before you start threads.",
        "02",
    ),
    (
        r"new node registered with same name|NodeNameTaken",
        "Two nodes have the same name. When the newer node registers, the master shuts down the older node.",
        "Use a different name for each node: `__name:=other`, or init_node(…, anonymous=True).",
        "01",
    ),
    (
        r"ROSInterruptException|node shutdown interrupted|rospy has shut down|NotJoined",
        "The node was shut down by Ctrl-C, by an interrupt of rospy.spin(), or by a node with the same name.",
        "Start the program again. In a notebook, run the cell with join() again, and never call spin().",
        "12",
    ),
    (
        r"time is not initialized|ROSInitException",
        "The program used a function that needs a node, but the program is not a node yet.",
        "Call init_node() first; in a notebook, call join().",
        "02",
    ),
    (
        r"topic types do not match",
        "The publisher and the subscriber of a topic use different types. The subscriber gets "
        "no error message.",
        "Use `rostopic info` to find the type of the topic, and use this type in both nodes.",
        "02",
    ),
    (
        r"Name or service not known|Temporary failure in name resolution|Unknown host \[|"
        r"attempted to connect to non-local host",
        "The server is registered with a host name that this machine does not know.",
        "Start the server with ROS_HOSTNAME=localhost.",
        "12",
    ),
)
