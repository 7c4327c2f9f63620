"""05.5: a program with two services; one service can be shut down and served again."""

from __future__ import annotations

from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.commands.folder import Running, telling_line
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.plain_values import Message
from course_pkg.checking.result import Finished
from course_pkg.checking.shared.script import require_shebang
from course_pkg.checking.shared.served_by import require_served_by_program, require_still_served
from course_pkg.ros.protocol.probe import ask_all, header_fields, service_probe
from course_pkg.ros.protocol.snapshot import ServiceSeen
from course_pkg.waiting import at_this_load, wait_until

FILE = "arm.py"
MOVE, MAINTENANCE = "/move_arm", "/maintenance"
STARTS = 8.0  # The program must offer both services within this time in s; it takes 0.5 s on an idle machine.
POLL = 0.1  # POLL is the time in s between two snapshots of the graph.
# A process that imports the file ends with this exit status, unless the file ends the process earlier.
IMPORTED = 77
IMPORT = f"import arm; raise SystemExit({IMPORTED})"
START = f"""%%writefile {FILE}
#!/usr/bin/env python3
..."""
MOVES = "Serve /move_arm and /maintenance, and count the moves."
CLOSES = (
    "When /maintenance is called with True, shut /move_arm down. Return the state after the call, "
    "and whether it changed."
)


@part(
    "05.5",
    points=3,
    goal=(
        "Write arm.py, a node that serves /move_arm and /maintenance. A call of /maintenance "
        "with True shuts /move_arm down; a call with False starts /move_arm again."
    ),
    needs=[f"file:{FILE}"],
    deadline=30.0,
    start=START,
    goals=[MOVES, CLOSES, "After the maintenance, serve /move_arm again, and continue to count the moves."],
)
def close_for_maintenance(context: CheckContext) -> None:
    """Start the program; call /move_arm, close this service twice, open it twice, and call it again."""
    require_shebang(
        context,
        FILE,
        missing=(
            "The shebang is missing: the first line has to name the program that runs the file. Begin "
            "line 1 with #!/usr/bin/env python3."
        ),
    )
    folder = context.folder(files=[FILE])
    _can_be_imported(context, folder.command("python", "-c", IMPORT, within=4.0, worded="import arm"))
    with folder.start("python", FILE, worded=f"python3 {FILE}") as program:
        _serves(context, program)
        require_served_by_program(context, program, MOVE, MAINTENANCE, itself=True)
        _works(context)
        require_still_served(context, MOVE, MAINTENANCE)
        require_served_by_program(context, program, MOVE, MAINTENANCE, itself=True)


def _serves(context: CheckContext, program: Running) -> None:

    def ready() -> bool:
        seen = context.look()
        return bool(seen.service(MOVE) and seen.service(MAINTENANCE)) or program.status is not None

    wait_until(ready, at_this_load(STARTS), POLL)
    seen = context.look()
    ended = program.status is not None
    missing = [name for name in (MOVE, MAINTENANCE) if not seen.service(name)]
    output = program.stop().out if missing or ended else ""
    printed = telling_line(output)
    context.require(
        "arm.py serves /move_arm and /maintenance",
        holds=not missing and not ended,
        expected="both services, and a program that keeps running",
        actual=f"no {' and no '.join(missing)}; the program printed: {printed}" if missing else printed,
        hints=_about_start(ended, output),
    )


def _about_start(ended: bool, output: str) -> str:
    if not ended:
        return (
            "The program runs, but a service is missing. Compare the names of the services, "
            "and create both services at the start."
        )
    if "rospy.init_node() first" in output:
        return "A service needs a node. Call rospy.init_node before you create the first service."
    if "Traceback" in output:
        return (
            "An exception has ended the program. Start the program in a terminal, and read the "
            "last line of the output."
        )
    return (
        "The program has ended, because it does not wait. Write rospy.spin() in the last line: "
        "this function waits until the node is stopped."
    )


def _works(context: CheckContext) -> None:
    move = context.service(MOVE, "std_srvs/Trigger")
    maintenance = context.service(MAINTENANCE, "std_srvs/SetBool", hints=SWITCHES)
    _counts(context, [move(), move()], 1)
    context.fulfilled(MOVES)
    address = context.look().service(MOVE)
    for data, changed in ((False, False), (True, True), (True, False)):
        _switches(context, maintenance(data=data), closed=data, changed=changed)
    _is_closed(context, address)
    context.fulfilled(CLOSES)
    _switches(context, maintenance(data=False), closed=False, changed=True)
    context.require(
        "after the maintenance, /move_arm is served again",
        holds=bool(context.look().service(MOVE)),
        expected=MOVE,
        actual=f"no {MOVE}",
        hints=(
            "/move_arm does not exist after the maintenance. Create this service again when "
            "/maintenance is called with data=False."
        ),
    )
    _switches(context, maintenance(data=False), closed=False, changed=False)
    _counts(context, [context.service(MOVE, "std_srvs/Trigger")()], 3)
    _in_a_random_order(context, maintenance, 3)


def _in_a_random_order(context: CheckContext, maintenance: Service, moves: int) -> None:
    """Close and open /move_arm in a random order, and call it when it is open; at the end, it is open."""
    closed = False
    for _ in range(context.random.integer(5, 8)):
        data = context.random.choice([True, False])
        _switches(context, maintenance(data=data), closed=data, changed=data is not closed)
        closed = data
        if not closed:
            moves += 1
            _counts(context, [context.service(MOVE, "std_srvs/Trigger")()], moves)
    _switches(context, maintenance(data=False), closed=False, changed=closed)


def _counts(context: CheckContext, responses: list[Message], first: int) -> None:
    context.expect(
        "the message of /move_arm is the number of moves since the start",
        expected=[str(first + number) for number in range(len(responses))],
        actual=[response.message for response in responses],
        hints=[
            (
                ["1"],
                "After the maintenance, the count starts from 1 again. Create the counter only "
                "once, at the start.",
            ),
            (["0", "1"], "The first move returned 0. Add 1 to the count before you return the message."),
            (
                ["1", "1"],
                "The count is 1 after every call. Store the count in an object or in a global variable.",
            ),
            (
                ANYTHING,
                "The count is wrong. Add 1 in each call of /move_arm, and do not change the number "
                "in any other call.",
            ),
        ],
    )
    context.require(
        "success is True in each response of /move_arm",
        holds=all(response.success for response in responses),
        expected="success=True",
        actual="success=False",
        hints="In a response of /move_arm, success is False. Set `success` to True after each move.",
    )


def _switches(context: CheckContext, response: Message, *, closed: bool, changed: bool) -> None:
    context.expect(
        'the message of /maintenance is "closed" or "open"',
        expected="closed" if closed else "open",
        actual=response.message,
        hints=(
            'The message has to be the state after the call: "closed" for data=True, and "open" for '
            "data=False."
        ),
    )
    context.expect(
        "success shows whether the call changed the state",
        expected=changed,
        actual=response.success,
        hints=[
            (
                True,
                "The state did not change, but success is True. Compare the field `data` with "
                "the state before the call.",
            ),
            (False, "The call changed the state, but success is False. Return success=True in this case."),
        ],
    )


def _is_closed(context: CheckContext, address: ServiceSeen | None) -> None:
    context.require(
        "during maintenance, /move_arm is not registered with the master",
        holds=not context.look().service(MOVE),
        expected=f"no {MOVE}",
        actual=f"{MOVE} is registered",
        hints="The service still exists. Store the rospy.Service object, and call shutdown() of this object.",
    )
    probes = [service_probe(MOVE, address.uri)] if address else []
    ask_all(probes, 1.0)
    context.require(
        "during maintenance, no server answers at the address of /move_arm",
        holds=not any("type" in header_fields(probe.answer) for probe in probes),
        expected="no answer",
        actual="an answer",
        hints=(
            "The service is no longer registered, but the server still answers. Call "
            "shutdown() of the rospy.Service object."
        ),
    )


def _can_be_imported(context: CheckContext, done: Finished) -> None:
    context.require(
        "an import of the file does not start the program",
        holds=done.status == IMPORTED and not (done.out + done.err).strip(),
        expected="an import that ends",
        actual="an import that does not end" if done.status is None else telling_line(done.out + done.err),
        hints=(
            "An import of the file starts the node. Move the lines that start the node below the line "
            "`if __name__ == '__main__':`."
        )
        if done.status is None
        else "Python cannot import the file. Start the file in a terminal, and read the last line "
        "of the output.",
    )


SWITCHES: Hints = [
    (
        matches("already registered"),
        "The program created /move_arm, although it already served /move_arm. Create /move_arm again "
        "only after shutdown(), and store each new rospy.Service object in the same variable.",
    ),
    (
        matches("NoneType|shutdown"),
        "A second call of /maintenance with the same value failed. First compare `data` with "
        "the current state.",
    ),
    (
        matches("unavailable|transport error|refused|reset|closed"),
        "The program ended during the calls. Shut down only the service /move_arm, not the node.",
    ),
    (
        matches("returned None"),
        "The handler of /maintenance returned None. Return a response in every case.",
    ),
]
