"""The programs that cases have in common: who serves the door, and who asks for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
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
    """Return the program that serves the door with this body of a handler; `changes` replaces words of it."""
    code = _KEEPER.format(body=body.replace("\n", "\n    "))
    for old, new in changes.items():
        code = code.replace(old, new)
    return code


def running(code: str) -> Callable[[Stage], None]:
    """Return what causes a fault that is all in the program that serves the door."""

    def play(stage: Stage) -> None:
        stage.serve(code)

    return play


def serving(body: str, imports: str = "") -> Callable[[Stage], None]:
    """Return what causes a fault that is all in the handler."""
    return running(imports + keeper(body))


def nothing(_: Stage) -> None:
    """Leave the graph as it is."""


def kill_server(stage: Stage) -> None:
    """Have a server, and kill it."""
    stage.serve(keeper()).kill()


def asking(lines: str, imports: str = "from std_srvs.srv import SetBool") -> str:
    """Return a visitor that does something else once it is a node."""
    return f'import rospy\n{imports}\n\nrospy.init_node("visitor")\n{lines}\n'


def calling(call: str) -> str:
    """Return a visitor that makes another call of the door."""
    return VISITOR.replace("print(move_door(True))", call)
