"""07.4: the geometry server, a program in the student's own package."""

from __future__ import annotations

from course_pkg.chapters.ch07_build_a_package.checks.packages import MY_GEOMETRY, geometry_class
from course_pkg.chapters.ch07_build_a_package.checks.program import (
    Program,
    can_be_imported,
    is_a_script,
    is_executable,
    serves,
)
from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.shared.catkin_package import built
from course_pkg.checking.shared.geometry import expect_geometry, is_rounded, random_boxes
from course_pkg.checking.shared.served_by import require_still_served

SERVER = Program("scripts/server.py", "SERVER_NODE", "/getGeometry")
FILE = MY_GEOMETRY.path(SERVER.file)

START = f"""%%writefile {FILE}
..."""
STARTED = "Start the node SERVER_NODE with the service /getGeometry."


@part(
    "07.4",
    points=3,
    goal=(
        "Write server.py: the node SERVER_NODE serves /getGeometry. The area is width times "
        "length, and the volume is area times height."
    ),
    needs=[f"file:{FILE}"],
    deadline=120.0,
    start=START,
    goals={STARTED: 1, "Return the area and the volume in the response.": 2},
)
def the_server(context: CheckContext) -> None:
    """Build a copy of the package, start its program in another namespace, and call the service."""
    is_a_script(context, FILE)
    is_executable(context, FILE)
    package = built(context, MY_GEOMETRY, examined=SERVER.file)
    can_be_imported(context, package, SERVER)
    space = f"/{context.random.word()}"
    name = f"{space}{SERVER.service}"
    line = f"rosrun my_geometry {SERVER.name} __ns:={space} {SERVER.service}:={name}"
    with package.start(line, worded=f"rosrun my_geometry {SERVER.name}") as running:
        serves(context, running, package, SERVER, name, f"{space}/{SERVER.node}")
        measure = context.service(name, geometry_class(), timeout=5.0)
        context.fulfilled(STARTED)
        for box in random_boxes(context):
            _answers(context, measure, *box)
        length, width = context.random.numbers(2, 0.5, 9.0)
        require_still_served(context, name)
        _answers(context, measure, length, width, 0.0)


def _answers(context: CheckContext, measure: Service, length: float, width: float, height: float) -> None:
    response = measure(length=length, width=width, height=height)
    expect_geometry(
        context,
        response,
        width * length,
        height,
        area=[
            (
                0.0,
                "The area is 0.0, because the server did not set the field. Set the area to width "
                "times length.",
            ),
            (
                width + length,
                "Your area is the sum of width and length. Multiply the two sides; do not add them.",
            ),
            (2 * (width + length), "Your area is the perimeter. Return width times length."),
            (width * height, "Your area is width times height. Return the area of the floor."),
            (is_rounded(width * length), "The area is rounded. Do not round the area."),
            (ANYTHING, "The area is wrong. Compute the area from request.width and request.length."),
        ],
        volume=[
            (
                0.0,
                "The volume is 0.0, because the server did not set the field. Set the volume to "
                "area times height.",
            ),
            (
                is_rounded(width * length * height),
                "The volume is rounded. Do not round the volume.",
            ),
            (ANYTHING, "The volume is wrong. Compute the volume from the area and request.height."),
        ],
    )
