"""00.1: the names of the server's node, its service, and the type of this service."""

from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Condition

NODE, SERVICE, TYPE = (
    "Find the name of the node.",
    "Find the name of the service.",
    "Find the type of the service.",
)
LINES: tuple[Condition, str] = (
    lambda actual: isinstance(actual, list),
    "Your answer is a list of lines, such as the output of a `!` command. Write only the name as a string, "
    "in quotes.",
)


@part(
    "00.1",
    points=1,
    goal=(
        "Find the node that measures boxes, the service that this node offers, and the type of this service."
    ),
    needs=["name_of_node", "name_of_service", "name_of_type"],
    goals=[NODE, SERVICE, TYPE],
    runs=["server"],
)
def read_the_graph(context: CheckContext) -> None:
    """Compare the right names of the node, the service and the type with the names that the student found."""
    with context.goal(NODE):
        context.expect(
            "the name of the node is right",
            expected="/SERVER_NODE",
            actual=context.read("name_of_node"),
            hints=[
                LINES,
                (
                    "SERVER_NODE",
                    (
                        "Your answer is almost right, but every name on the graph starts with a slash. "
                        "Add the slash."
                    ),
                ),
                (
                    matches("^/?server$"),
                    (
                        "Your answer is the name of the program. The command `rosnode list` shows "
                        "the names of the nodes."
                    ),
                ),
                (
                    matches("^/chapter"),
                    (
                        "Your answer is the node of this notebook, which is the client. Find the "
                        "node of the server."
                    ),
                ),
                (
                    matches("getGeometry"),
                    "Your answer is the name of a service. Find the node that offers this service.",
                ),
                (
                    matches("^/server_node/?$"),
                    "Compare your answer with the name on the graph, letter by letter. Check the "
                    "capital letters, and write only one slash, at the start of the name.",
                ),
                (
                    ANYTHING,
                    "Your answer is not the name of the server's node. Look for this name in the output "
                    "of `rosnode list`.",
                ),
            ],
        )
    with context.goal(SERVICE):
        context.expect(
            "the name of the service is right",
            expected="/getGeometry",
            actual=context.read("name_of_service"),
            hints=[
                LINES,
                (
                    "getGeometry",
                    (
                        "Your answer is almost right, but every name on the graph starts with a slash. "
                        "Add the slash."
                    ),
                ),
                (
                    matches("logger"),
                    (
                        "Every node offers a service for log messages, such as the one in your "
                        "answer. Find the service that measures boxes."
                    ),
                ),
                (
                    matches("^/?SERVER_NODE$"),
                    (
                        "Your answer is the name of the node. The command `rosservice list` shows "
                        "the names of the services."
                    ),
                ),
                (
                    matches("course_pkg"),
                    "Your answer is the type of the service. The name of the service is the "
                    "text that you write after `rosservice call`.",
                ),
                (
                    matches("^/getgeometry/?$"),
                    "Compare your answer with the name on the graph, letter by letter. Check the "
                    "capital letters, and write only one slash, at the start of the name.",
                ),
                (
                    ANYTHING,
                    "Your answer is not the name of the service that measures boxes. Look for this name in "
                    "the output of `rosservice list`.",
                ),
            ],
        )
    with context.goal(TYPE):
        context.expect(
            "the type of the service is right",
            expected="course_pkg/geometry",
            actual=context.read("name_of_type"),
            hints=[
                LINES,
                (
                    matches("^geometry$"),
                    "The name of the package is missing. Write the type in the form package/type.",
                ),
                (
                    matches("^/course_pkg"),
                    "The name of a type does not start with a slash. Remove the slash.",
                ),
                (
                    matches(r"object|course_pkg\.srv"),
                    "Your answer is the Python class of the type. Write the name of the type "
                    "as a string in the form package/type.",
                ),
                (
                    matches("getGeometry"),
                    (
                        "Your answer is the name of the service. The command `rosservice type` "
                        "shows the type of a service."
                    ),
                ),
                (
                    matches("(?-i:course_pkg/Geometry)"),
                    ("The name of this type starts with a small letter. Write `geometry` with a small g."),
                ),
                (
                    ANYTHING,
                    "Your answer is not the type of the service that measures boxes. Write the "
                    "name of this service after `rosservice type`.",
                ),
            ],
        )
