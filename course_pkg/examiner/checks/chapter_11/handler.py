"""11.2: a server in C++, repaired: its handler, and what main does with it."""

from __future__ import annotations

import re

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.calls import Service
from course_pkg.examiner.checks.chapter_11.programs import BOX, PACKAGE, code_of, compiled, serves, started

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
SIDES = ("length", "width", "height")
NOTHING = "A side was 0, and 0 is not below 0: such a box has no volume, and that is an answer."
SAID_NO = (
    "The handler returned false, which says: I could not. Its words are lost, and the caller gets b''. "
    "Return true where the answer is good."
)


@part(
    "11.2",
    points=3,
    goal="Repair box_server.cpp: it measures boxes under the name box, refuses a side below 0, and goes on.",
    needs=[f"file:{FILE}"],
    deadline=90.0,
    start=START,
)
def the_server(exam: Exam) -> None:
    """Compile a copy, start it under a name of the check's own, and call it."""
    folder = compiled(exam, FILE)
    name = f"/{exam.draw.word()}"
    with started(exam, folder, "box", name) as running:
        serves(exam, running, "box", name, code_of(exam, FILE))
        box = exam.service(name, BOX, hints=[(says("responded with an error"), SAID_NO)], timeout=8.0)
        wrong = exam.draw.shuffled(SIDES)
        for sides in ([wrong[0]], [wrong[1]], [wrong[2]], wrong[:2]):
            _measures(exam, box)
            _refuses(exam, box, sides)
        _takes_nothing(exam, exam.service(name, BOX, hints=[(says("responded with an error"), NOTHING)]))


def _measures(exam: Exam, box: Service) -> None:
    length, width, height = (side + 0.37 for side in exam.draw.numbers(3, 1.0, 9.0))
    response = box(length=length, width=width, height=height)
    area = length * width
    exam.expect(
        "area is length times width, fractions included",
        expected=area,
        seen=response.area,
        near=1e-3,
        hints=[
            (0.0, "A field that nobody fills is 0. A response that is taken by value is a copy: write &."),
            (float(int(area)), "The fraction is gone: an int holds whole numbers only. Take float, or auto."),
            (length + width, "That is length + width. An area is a product."),
        ],
    )
    exam.expect(
        "volume is area times height",
        expected=area * height,
        seen=response.volume,
        near=1e-3,
        hints=[
            (0.0, "A field that nobody fills is 0."),
            (float(int(area * height)), "The fraction is gone: an int holds whole numbers only."),
            (int(area) * height, "The area lost its fraction on the way: an int holds whole numbers only."),
            (says(""), "Multiply the area by the height."),
        ],
    )


def _takes_nothing(exam: Exam, box: Service) -> None:
    for side in SIDES:
        response = box(**{each: 0.0 if each == side else 2.5 for each in SIDES})
        exam.expect("volume is area times height", expected=0.0, seen=response.volume, hints=NOTHING)


def _refuses(exam: Exam, box: Service, wrong: list[str]) -> None:
    sides = dict(zip(SIDES, exam.draw.numbers(3, 1.0, 9.0), strict=True))
    sides.update({side: -sides[side] for side in wrong})
    below = " and ".join(wrong)
    box.refused(
        "a side below 0 is refused",
        saying="responded with an error",
        hints=[
            (
                says("TimesUp|transport"),
                "The program ended, or hangs: a refusal is return false, and no more.",
            ),
            (re.compile(""), f"It answered, and below 0: {below}. Return false there, before measuring."),
        ],
        **sides,
    )
