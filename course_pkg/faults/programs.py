"""The programs that several faults use: the server of /door (`keeper`), and its client (`VISITOR`)."""

from __future__ import annotations

from collections.abc import Callable

from course_pkg.faults.stage import Stage

WELL = 'return SetBoolResponse(True, "open" if request.data else "shut")'

VISITOR = """\
import rospy
from std_srvs.srv import SetBool

rospy.init_node("visitor")
move_door = rospy.ServiceProxy("/lab/door", SetBool)
print(move_door(True))
"""

_KEEPER = """\
import rospy
from std_srvs.srv import SetBool, SetBoolResponse

def handle(request):
    {body}

rospy.init_node("keeper")
rospy.Service("/lab/door", SetBool, handle)
rospy.spin()
"""


def keeper(body: str = WELL, **changes: str) -> str:
    """Return a program that serves /door; `body` is the code of its handler.

    Each key of `changes` is a text in the program; its value replaces this text.
    """
    code = _KEEPER.format(body=body.replace("\n", "\n    "))
    for old, new in changes.items():
        code = code.replace(old, new)
    return code


def running(code: str) -> Callable[[Stage], None]:
    """Return a function that starts the faulty server `code` of /door on a stage."""

    def play(stage: Stage) -> None:
        stage.serve(code)

    return play


def serving(body: str, imports: str = "") -> Callable[[Stage], None]:
    """Return a function that starts a server of /door on a stage; `body` is the code of its handler."""
    return running(imports + keeper(body))


def nothing(_: Stage) -> None:
    """Do not change the graph; some faults need only the program that shows the symptom."""


def kill_server(stage: Stage) -> None:
    """Start a server, and kill it with SIGKILL."""
    stage.serve(keeper()).kill()


def asking(lines: str, imports: str = "from std_srvs.srv import SetBool") -> str:
    """Return the source code of a program that starts the node `visitor` and then runs the given lines."""
    return f'import rospy\n{imports}\n\nrospy.init_node("visitor")\n{lines}\n'


def calling(call: str) -> str:
    """Return the source code of a client in which the code `call` replaces the call of /door."""
    return VISITOR.replace("print(move_door(True))", call)
