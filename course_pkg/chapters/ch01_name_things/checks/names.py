"""Checks that start nodes with the student's commands, and examine the names of these nodes on the graph."""

from __future__ import annotations

import difflib
import time
from contextlib import ExitStack, suppress

from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Condition
from course_pkg.checking.commands.folder import Running
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.plain_values import Value
from course_pkg.checking.shared.command_line import OPERATORS, commands_of
from course_pkg.checking.shared.served_by import require_served_by_program
from course_pkg.ros.protocol.snapshot import ServiceSeen, Snapshot
from course_pkg.ros.protocol.xmlrpc import NO_ANSWER, RpcValue, XmlRpcClient

GEOMETRY = "course_pkg/geometry"
TOPICS = ("joint_states", "mirrored_joints")  # The viewer uses these topics.
TIMEOUT = 5.0  # A running node has to list its topics within this time in s.
START = 20.0  # A program may take up to this time in s to start; usually, it takes 0.5 s.
WHERE = "the service is called measure, and it is in the namespace of the room"
OWN_SERVICE = "Start a server that offers the service `measure` in the namespace of the room."
OWN_NODE = "Give the server's node the name `measurer`, and start this node in the namespace of the room."
CAPITALS = (
    "In ROS, a name with a capital letter differs from the same name with a small letter. Use the argument "
    "of your function without any change."
)
VIEWER = (
    "Give the viewer's node the name ARM_viewer in the namespace /screen, where ARM is the name of the arm."
)
SUBSCRIBES = "Let the viewer subscribe to the topic `joint_states` of its arm."
PUBLISHES = (
    "Let the viewer publish on the topic /screen/ARM/mirrored_joints, where ARM is the name of the arm."
)


@part(
    "01.1",
    points=2,
    goal=(
        "Return the command that starts the server of a room. The node `measurer` and the "
        "service `measure` have to be in the namespace of the room."
    ),
    needs=["measurer_command"],
    deadline=60.0,
    goals=[OWN_SERVICE, OWN_NODE],
    runs=["server"],
)
def a_measurer_for_each_room(context: CheckContext) -> None:
    """Run the student's commands for two rooms, and call the servers that the commands start."""
    rooms = _names(context, "Room")
    with ExitStack() as running:
        servers, nodes = {}, set()
        for room in rooms:
            before = {service.uri for service in context.look().services}
            servers[room], words = _start(context, running, "measurer_command", room, "server")
            node = _serves(context, servers[room], words, room, before)
            if node in nodes:
                context.fail(
                    "the service of each room measures boxes",
                    expected="two servers that run at the same time",
                    actual=f"two servers with the name {node}",
                    hint=(
                        "The nodes of two rooms have the same name. When the second node starts, the "
                        "master ends the first node."
                    ),
                )
            nodes.add(node)
        for room in context.random.shuffled(rooms):
            length, width, height = context.random.numbers(3, 0.5, 9.0)
            measure = context.service(f"/{room}/measure", GEOMETRY)
            context.expect(
                "the service of each room measures boxes",
                expected=length * width,
                actual=measure(length=length, width=width, height=height).area,
                near=1e-3,
            )
        for room, server in servers.items():
            require_served_by_program(context, server, f"/{room}/measure")
    context.fulfilled(OWN_SERVICE)


@part(
    "01.2",
    points=2,
    goal="Return the command that starts a viewer for one arm, in the namespace /screen.",
    needs=["viewer_command"],
    deadline=60.0,
    goals=[VIEWER, SUBSCRIBES, PUBLISHES],
    runs=["simulator"],
)
def a_viewer_for_each_arm(context: CheckContext) -> None:
    """Run the student's commands for two arms, and check the names of the nodes and of their topics."""
    with ExitStack() as running:
        for arm in _names(context, "Arm"):
            before = {node.uri for node in context.look().nodes}
            viewer, words = _start(context, running, "viewer_command", arm, "simulator")
            _views(context, viewer, words, arm, before)


def _names(context: CheckContext, ending: str) -> list[str]:
    """Return two random names in a random order; one of them ends with `ending` and a digit.

    The capital letter in `ending` shows whether the student's command changes the name.
    """
    first, second = (context.random.word() for _ in range(2))
    return context.random.shuffled([first, f"{second}{ending}{context.random.integer(1, 9)}"])


def _start(
    context: CheckContext, running: ExitStack, function: str, name: str, program: str
) -> tuple[Running, list[str]]:
    """Call the student's function `function` with the argument `name`, and run the returned command.

    Return the running command and its words. The command ends when the ExitStack `running` is closed.
    """
    command = context.run(function, name).returned()
    commands = commands_of(command)
    words = commands[0] if len(commands) == 1 else []
    context.require(
        "the result is a command for rosrun",
        holds=words[:3] == ["rosrun", "course_pkg", program],
        expected=f"a string that begins with rosrun course_pkg {program}",
        actual=command,
        hints=[
            (None, NO_RETURN),
            (
                lambda actual: isinstance(actual, list),
                "Your function returned a list. Return one string with spaces between the words.",
            ),
            (
                matches("^[!%]"),
                "A command that begins with ! or % works only in a notebook. Remove this character.",
            ),
            (
                matches("object"),
                (
                    "Your function has to return the command as a string. Do not run the command "
                    "yourself, because the check runs it."
                ),
            ),
            (
                matches(rf"^rosrun course_pkg {program}\b.*[{OPERATORS}]"),
                "Your string contains more than one command. Return only one command: its remappings "
                "have to set all names.",
            ),
            (
                ANYTHING,
                "The command has to begin with `rosrun`, the name of the package and the name of the "
                "program.",
            ),
        ],
    )
    return running.enter_context(context.folder().start(*words, worded=str(command))), words


def _serves(context: CheckContext, server: Running, words: list[str], room: str, before: set[str]) -> str:
    """Assert that the room's service and node have the right names; return the name of the node.

    `words` contains the words of the command that started the server. `before` contains the addresses of the
    services that existed before the server was started.
    """
    wanted, node = f"/{room}/measure", f"/{room}/measurer"
    deadline, service = time.monotonic() + START, None
    new: list[ServiceSeen] = []
    while service is None and time.monotonic() < deadline and server.status is None:
        seen = context.look()
        service = seen.service(wanted)
        others = [other for other in seen.services if other.uri not in before and other.type == GEOMETRY]
        # Keep the services that were found first, because a busy server does not always respond again.
        new = new or others
        deadline = min(deadline, time.monotonic() + 1.0) if new else deadline
    if service is None:
        found = new[0].name if new else ""
        hint = _astray(room, found, new[0].node if new else "", words)
        context.fail(WHERE, expected=wanted, actual=found or "no new service", hint=hint)
    context.require(WHERE, holds=True)
    with context.goal(OWN_NODE):
        context.expect(
            "the node is called measurer, and it is in the namespace of the room",
            expected=node,
            actual=service.node,
            hints=[
                (
                    matches("SERVER_NODE"),
                    "The node still has its default name. Change the name of the node with `__name:=…`.",
                ),
                (
                    "/measurer",
                    "The node is not in the namespace of the room. Use `__ns:=…` to set the "
                    "namespace of the node.",
                ),
                (
                    ANYTHING,
                    (
                        "The name of the node is wrong. The node has to be `measurer` in the namespace "
                        "of the room."
                    ),
                ),
            ],
        )
    require_served_by_program(context, server, wanted)
    return service.node


def _astray(room: str, found: str, node: str, words: list[str]) -> str:
    """Return the hint for a service with the wrong name `found`; the right name is /ROOM/measure.

    `node` is the name of the service's node, and `words` contains the words of the command.
    """
    if found.lower() == f"/{room}/measure".lower():
        return CAPITALS
    if found == "/measure" and node.startswith(f"/{room}/"):
        return (
            "The node is in the namespace of the room, but the name of the service is /measure for "
            "every room. Remove the slash from this name, because `__ns` does not change a name that "
            "begins with a slash."
        )
    if found == "/measure":
        return (
            "The name of the service is /measure for every room. Set the namespace of the "
            "node, and write `measure` without a slash."
        )
    if found == "/getGeometry":
        return (
            "The service still has its old name and namespace. Write each remapping as "
            "`old:=new`, without spaces."
        )
    if found == f"/{room}/{room}/measure":
        return (
            "The service's name contains the room twice, because `__ns` also puts a relative name into the "
            "namespace. Remove the room from the new name of the service."
        )
    ignored = [old for old, new in _renamed(words) if "getGeometry" not in (old.strip("/"), new.strip("/"))]
    if found == f"/{room}/getGeometry" and ignored:
        return (
            f"The program has no service `{ignored[0]}`, so ROS ignored your remapping. The old name has to "
            "be the name of the program's service, not the name of its type."
        )
    if found == f"/{room}/getGeometry":
        return (
            "The service is in the namespace of the room, but it still has its old name. Write "
            "the remapping as `old:=new`, with the old name first and without spaces."
        )
    if found == f"/{room}/measurer/measure":
        return (
            "A name that begins with ~ is private, so the service is in the namespace of the node. "
            "Remove the ~ from the name."
        )
    return (
        "The name of the service is wrong. The service has to be `measure` in the namespace of the "
        "given room."
    )


def _views(context: CheckContext, viewer: Running, words: list[str], arm: str, before: set[str]) -> None:
    """Assert that the started node and its topics have the right names for the arm `arm`.

    `words` contains the words of the command that started the node. `before` contains the addresses
    of the nodes that existed before the command was run.
    """
    name, seen = _viewer(context, viewer, before)
    with context.goal(VIEWER):
        context.expect(
            "the viewer's node has the right name and is in the namespace /screen",
            expected=f"/screen/{arm}_viewer",
            actual=name or "no new node that subscribes to a topic",
            hints=[
                _in_small_letters(f"/screen/{arm}_viewer"),
                (
                    matches("simulator$"),
                    "The node still has its default name. Choose the name of the node with `__name:=…`.",
                ),
                (
                    f"/{arm}_viewer",
                    "The node is not in the namespace /screen. Use `__ns:=/screen` to set the "
                    "namespace of the node.",
                ),
                (
                    ANYTHING,
                    "The name of the node has to be ARM_viewer in the namespace /screen, where "
                    "ARM is the name of the arm.",
                ),
            ],
        )
    with context.goal(SUBSCRIBES):
        context.expect(
            "the viewer subscribes to the arm's topic joint_states",
            expected=[f"/{arm}/joint_states"],
            actual=[topic.name for topic in seen.topics if name in topic.subscribers],
            hints=[
                *_ignored("joint_states", words),
                _in_small_letters([f"/{arm}/joint_states"]),
                (
                    ("/screen/joint_states",),
                    "The viewer subscribes to a topic in its own namespace, but no arm publishes on "
                    "this topic. Remap `joint_states` with `:=`.",
                ),
                (
                    (f"/screen/{arm}/joint_states",),
                    "The new name of the topic is relative, so the topic is in the namespace /screen. "
                    "Use a global name, which starts with a slash.",
                ),
                (
                    ANYTHING,
                    "The viewer does not subscribe to the topic of its arm. This topic is "
                    "`joint_states` in the namespace that has the name of the arm.",
                ),
            ],
        )
    published = [topic.name for topic in seen.topics if name in topic.publishers]
    _require_own_topics(context, viewer, name, seen)
    with context.goal(PUBLISHES):
        context.expect(
            "the viewer publishes on the arm's topic mirrored_joints",
            expected=[f"/screen/{arm}/mirrored_joints"],
            actual=[topic for topic in published if topic != "/rosout" and not topic.endswith("/pictures")],
            hints=[
                *_ignored("mirrored_joints", words),
                _in_small_letters([f"/screen/{arm}/mirrored_joints"]),
                (
                    ("/screen/mirrored_joints",),
                    "The viewers of all arms publish on the same topic. Also remap `mirrored_joints`.",
                ),
                (
                    (f"/{arm}/mirrored_joints",),
                    "The topic of the viewer is outside of the namespace /screen. Use a relative name: "
                    "ROS adds the namespace of the node to this name.",
                ),
                (
                    ANYTHING,
                    (
                        "The name of the topic has to be /screen/ARM/mirrored_joints, where ARM is "
                        "the name of the arm."
                    ),
                ),
            ],
        )


def _in_small_letters(expected: Value) -> tuple[Condition, str]:
    """Return a hint for a value that differs from `expected` only in its capital letters."""
    return (lambda actual: str(actual).lower() == str(expected).lower()), CAPITALS


def _renamed(words: list[str]) -> list[tuple[str, str]]:
    """Return the old and the new name of each remapping in `words`; skip names such as `__ns`."""
    pairs = [word.partition(":=") for word in words]
    return [(old, new) for old, separator, new in pairs if separator and old and not old.startswith("__")]


def _ignored(topic: str, words: list[str]) -> list[tuple[tuple[str], str]]:
    """Return a hint for a remapping in `words` that does not rename the topic `topic`, as it should.

    The topic still has its old name in the namespace /screen. If there is no such remapping, return [].
    """
    if any(new.strip("/") == topic and old not in TOPICS for old, new in _renamed(words)):
        order = (
            "The two names in your remapping are in the wrong order. Write the name in the program first, "
            "then `:=`, and then the new name."
        )
        return [((f"/screen/{topic}",), order)]
    old = [old.strip("/") for old, _ in _renamed(words)]
    alike = [name for name in difflib.get_close_matches(topic, old) if name not in TOPICS]
    if topic in old or not alike:
        return []
    hint = (
        f"The program has no topic `{alike[0]}`, so ROS ignores this remapping. Compare the old name in the "
        "remapping letter by letter with the name of the topic."
    )
    return [((f"/screen/{topic}",), hint)]


def _require_own_topics(context: CheckContext, viewer: Running, name: str, seen: Snapshot) -> None:
    """Assert that the student's program reports the topics that the master lists for the node `name`.

    Any program can register topics under the name of this node, so the check also requests the topics from
    the student's program.
    """
    node = seen.node(name)
    own: list[RpcValue] = []
    if node and viewer.listens_at(node.uri):
        with suppress(OSError, *NO_ANSWER):
            client = XmlRpcClient(node.uri, TIMEOUT)
            own = [client.ask(method, "/check") for method in ("getSubscriptions", "getPublications")]
    listed = {topic.name for topic in seen.topics if name in {*topic.subscribers, *topic.publishers}}
    if node and not all(repr(topic) in str(own) for topic in listed):
        context.fail(
            "the node runs in the program that the command starts",
            expected="a node that runs in the program of the command",
            actual=f"{name}, which runs in no program of the command",
            hint=(
                "The viewer on the graph is not the program that your command starts. In the "
                "command, use remappings to set the name of the node and the names of the topics."
            ),
        )


def _viewer(context: CheckContext, viewer: Running, before: set[str]) -> tuple[str, Snapshot]:
    """Wait for a new node with a subscription; return its name (or "") and the last snapshot of the graph.

    A new node may have the name of an earlier node, which the master then ends, so compare the addresses. The
    first snapshot may still contain the topics of the earlier node, so wait for two equal results.
    """
    deadline, earlier = time.monotonic() + START, [""]
    while True:
        seen = context.look()
        subscribers = {node for topic in seen.topics for node in topic.subscribers}
        new = sorted({node.name for node in seen.nodes if node.uri not in before} & subscribers)
        if new == earlier or time.monotonic() > deadline or viewer.status is not None:
            return (new[0] if new else ""), seen
        earlier = new or [""]
        time.sleep(0.05)
