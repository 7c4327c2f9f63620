"""13.2: a C++ server that the student repairs; its handler and its main function contain mistakes."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import combinations

from course_pkg.chapters.ch13_cpp.checks.compiled_program import (
    BOX,
    PACKAGE,
    code_of,
    compiled,
    serves,
    started,
)
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.shared.geometry import expect_geometry

FILE = f"{PACKAGE}/src/box_server.cpp"

START = f"""%%writefile {FILE}
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request request, course_pkg::geometry::Response response) {{
  int area = request.length * request.width;
  response.area = area;
  response.volume = area * request.height;
}}

int main(int argc, char** argv) {{
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  node.advertiseService("box", measure);
}}
"""
AREA = "area is length times width, with the digits after the decimal point"  # the title of an assertion
SIDES = ("length", "width", "height")
FRACTION_BELOW = (
    "The server did not refuse a request in which a side is between -1 and 0. Compare the field of the "
    "request with 0 before you convert it: the conversion to int changes such a side to 0."
)
EMPTY_AREA = (
    "The height was 0, so the volume is 0, but the area is not 0. Return length times width as the area of "
    "each box with a height of 0."
)
NO_FRACTION = (
    "The digits after the decimal point are missing, because an int stores only whole numbers. Use "
    "float or auto."
)
ZERO_IS_ALLOWED = (
    "A side was 0, but the handler refused the call. Refuse only a side below 0, and return the "
    "volume 0 for a side of 0."
)
RETURNED_FALSE = (
    "The handler returned false for a valid request, so the client got an error. Return true after "
    "you have set the fields of the response."
)


@part(
    "13.2",
    points=3,
    goal=(
        "Repair box_server.cpp: its service `box` returns the area and the volume, and refuses a "
        "side below 0."
    ),
    needs=[f"file:{FILE}"],
    deadline=90.0,
    start=START,
)
def box_server(context: CheckContext) -> None:
    """Compile a copy of the student's file, start it with a random service name, and call the service."""
    folder = compiled(context, FILE)
    name = f"/{context.random.word()}"
    with started(context, folder, "box", name) as running:
        serves(context, running, "box", name, code_of(context, FILE))
        box = context.service(
            name, BOX, hints=[(matches("responded with an error"), RETURNED_FALSE)], timeout=4.0
        )
        wrong = context.random.shuffled(SIDES)
        for count in (1, 2, 3):
            for sides in combinations(wrong, count):
                running.examine()
                _measures(context, box)
                _refuses(context, box, sides)
        for side in wrong:
            _refuses(context, box, [side], -context.random.number(0.1, 0.9))
        for number in range(context.random.integer(1, 20)):
            _measures(context, box, 0.01 if number == 0 else 1.0)
        _measures_empty_boxes(
            context, context.service(name, BOX, hints=[(matches("responded with an error"), ZERO_IS_ALLOWED)])
        )


def _wrong_area(length: float, width: float) -> Hints:
    return [
        (0.0, "The area is 0. Set response.area."),
        (
            float(int(length * width)),
            NO_FRACTION,
        ),
    ]


def _wrong_volume(area: float, height: float) -> Hints:
    return [
        (0.0, "The volume is 0. Set response.volume."),
        (float(int(area * height)), NO_FRACTION),
        (int(area) * height, NO_FRACTION),
        (ANYTHING, "The volume is wrong. Multiply the area by the height."),
    ]


def _measures(context: CheckContext, box: Service, scale: float = 1.0) -> None:
    length, width, height = (scale * (side + 0.37) for side in context.random.numbers(3, 1.0, 9.0))
    response = box(length=length, width=width, height=height)
    area = length * width
    expect_geometry(
        context,
        response,
        area,
        height,
        area=_wrong_area(length, width),
        volume=_wrong_volume(area, height),
        assertion=AREA,
    )


def _measures_empty_boxes(context: CheckContext, box: Service) -> None:
    for side in SIDES:
        response = box(**{each: 0.0 if each == side else 2.5 for each in SIDES})
        context.expect(
            AREA,
            expected=6.25 if side == "height" else 0.0,
            actual=response.area,
            near=1e-3,
            hints=EMPTY_AREA,
        )
        context.expect(
            "volume is area times height", expected=0.0, actual=response.volume, hints=ZERO_IS_ALLOWED
        )


def _refuses(context: CheckContext, box: Service, wrong: Sequence[str], value: float | None = None) -> None:
    """Assert that the server refuses a box; the sides `wrong` have the value `value`, or a value below -1."""
    sides = dict(zip(SIDES, context.random.numbers(3, 1.0, 9.0), strict=True))
    sides.update({side: -sides[side] if value is None else value for side in wrong})
    below = f"{' and '.join(wrong)} {'was' if len(wrong) == 1 else 'were'}"
    box.refused(
        "the server refuses a side below 0",
        saying="responded with an error",
        hints=[
            (
                matches("TimesUp|transport"),
                (
                    "The program has ended, or it does not respond. To refuse a call, return false "
                    "from the handler, and do not end the program."
                ),
            ),
            (
                re.compile(""),
                FRACTION_BELOW
                if value is not None
                else f"The server sent a response, but {below} below 0. Refuse such a request: return false.",
            ),
        ],
        **sides,
    )
