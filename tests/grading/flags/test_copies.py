"""Copies get a flag even if names, comments and the order of statements were changed."""

from __future__ import annotations

from course_pkg.grading.grade import Submission
from tests.grading.flags.classes import flags_of, solutions, submission

SWITCH = '''import threading


class Switch:
    """A switch that two threads can use."""

    def __init__(self):
        self.lock = threading.Lock()
        self.history = [False]
        self.moves = 0

    def position(self):
        return self.history[-1]

    def store(self, wanted):
        self.history.append(wanted)
        self.moves += 1

    def handle_switch(self, request):
        with self.lock:
            moved = request.data != self.position()
            if moved:
                self.store(request.data)
            text = {True: "on", False: "off"}[self.position()]
        return SetBoolResponse(success=moved, message=text)


switch = Switch()
switch_service = rospy.Service("/switch", SetBool, switch.handle_switch)
'''
DISGUISED = '''import threading


class Switch:
    def handle_switch(self, req):
        with self.guard:  # only one thread at a time
            # did it change?
            different = req.data != self.now()
            if different:
                self.remember(req.data)
            answer = {True: "on", False: "off"}[self.now()]
        return SetBoolResponse(message=answer, success=different)

    def remember(self, value):
        self.number = 1 + self.number
        self.states.append(value)

    def now(self):
        """The last state."""
        return self.states[-1]

    def __init__(self):
        self.number: int = 0
        self.states = [False]
        self.guard = threading.Lock()


switch = Switch()
switch_service = rospy.Service("/switch", SetBool, switch.handle_switch)
'''
OTHER = """class Switch:
    def __init__(self):
        self.state = "off"

    def on(self):
        changed = self.state == "off"
        self.state = "on"
        return changed

    def off(self):
        changed = self.state == "on"
        self.state = "off"
        return changed

    def handle_switch(self, request):
        if request.data:
            changed = self.on()
        else:
            changed = self.off()
        return SetBoolResponse(success=changed, message=self.state)


switch = Switch()
switch_service = rospy.Service("/switch", SetBool, switch.handle_switch)
"""
CPP = """%%writefile src/my_turtles_cpp/src/spawn_turtle.cpp
#include <ros/ros.h>
#include <turtlesim/Spawn.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "spawner");
  ros::NodeHandle node;
  double x = 2.0;
  double y = 3.0;
  ros::ServiceClient client = node.serviceClient<turtlesim::Spawn>("/spawn");
  client.waitForExistence();
  turtlesim::Spawn spawn;
  spawn.request.x = x;
  spawn.request.y = y;
  spawn.request.theta = x / y + 0.25;
  spawn.request.name = "second";
  if (!client.call(spawn)) {
    ROS_ERROR("no turtle at %f", x);
    return 2;
  }
  ROS_INFO("there is %s", spawn.response.name.c_str());
  return 0;
}
"""
CPP_DISGUISED = """%%writefile src/my_turtles_cpp/src/spawn_turtle.cpp
#include <turtlesim/Spawn.h>
#include <ros/ros.h>

// the main function
int main(int count, char** words)
{
  ros::init(count, words, "spawner");
  double down = 3.0;
  double right = 2.0;  // metres
  ros::NodeHandle handle;
  ros::ServiceClient proxy = handle.serviceClient<turtlesim::Spawn>("/spawn");
  proxy.waitForExistence();
  turtlesim::Spawn call;
  call.request.y = down;
  call.request.x = right;
  call.request.theta = right / down + 0.25;
  call.request.name = "second";
  if (!proxy.call(call))
  {
    ROS_ERROR("it failed at %f", right);
    return 2;
  }
  ROS_INFO("got %s", call.response.name.c_str());
  return 0;
}
"""


def _class(**answers: str) -> dict[str, tuple[str, ...]]:
    """For each student with a flag, return the students with a similar answer to exercise 05.4."""
    handed_in = [submission(student, {"05.4": source}) for student, source in answers.items()]
    return {student: flags[0].others for student, flags in flags_of(["copies"], *handed_in).items()}


def test_identical_answers() -> None:
    """Two students with identical answers get a flag, and a third student gets no flag."""
    assert _class(s01=SWITCH, s02=OTHER, s03=SWITCH) == {"s01": ("s03",), "s03": ("s01",)}


def test_a_disguised_copy() -> None:
    """A copy gets a flag even if its names, comments, types and order differ from the original."""
    assert _class(s01=SWITCH, s02=OTHER, s03=DISGUISED) == {"s01": ("s03",), "s03": ("s01",)}


def test_the_words_of_a_flag() -> None:
    """The flag says whether a copy is identical or disguised, and contains a line of the answer."""
    first = flags_of(
        ["copies"], submission("s01", {"05.4": SWITCH}), submission("s02", {"05.4": SWITCH + "\n"})
    )
    assert first["s01"][0].words == "The answers are identical."
    second = flags_of(["copies"], submission("s01", {"05.4": SWITCH}), submission("s02", {"05.4": DISGUISED}))
    assert second["s02"][0].words.startswith("The answers differ only in names")
    assert second["s02"][0].evidence in DISGUISED
    assert second["s02"][0].line > 0


def test_a_disguised_copy_in_cpp() -> None:
    """Copies of C++ programs get a flag."""
    first = submission("s01", {"14.1": CPP}, "14")
    copy = submission("s02", {"14.1": CPP_DISGUISED}, "14")
    assert set(flags_of(["copies"], first, copy)) == {"s01", "s02"}


def test_short_answers_do_not_count() -> None:
    """An answer with fewer than ten statements gets no flag."""
    short = solutions("05")["05.3"]
    assert flags_of(["copies"], *(submission(f"s{n}", {"05.3": short}) for n in range(2))) == {}


def test_code_that_the_class_shares_does_not_count() -> None:
    """If more than a tenth of a class has the same code, this code leads to no flag."""
    assert _class(**{f"s{number:02}": SWITCH for number in range(4)}) == {}
    assert len(_class(**{f"s{number:02}": SWITCH for number in range(3)})) == 3


def test_handed_out_code_does_not_count() -> None:
    """Unchanged cells lead to no flag."""
    assert flags_of(["copies"], *(submission(f"s{number}", {}) for number in range(3))) == {}


def test_students_who_handed_in_together() -> None:
    """The members of a group get no flags for their common file.

    If another student has a similar answer, the members of the group and this student get flags.
    """
    team = [submission(name, {"05.4": SWITCH}, origin="submission_1/05.ipynb") for name in ("s01", "s02")]
    assert flags_of(["copies"], *team) == {}
    flags = flags_of(["copies"], *team, submission("s03", {"05.4": SWITCH}))
    assert {student: each[0].others for student, each in flags.items()} == {
        "s01": ("s03",),
        "s02": ("s03",),
        "s03": ("s01", "s02"),
    }


def test_the_same_program_in_a_cell_and_in_a_package() -> None:
    """A file that a cell writes is compared with the same file in a package."""
    from course_pkg.grading.grade import Package
    from course_pkg.sandbox.job import work_file

    source = solutions("09")["09.3"]
    first, _, program = source.partition("\n")
    path = first.removeprefix("%%writefile src/my_turtles/")
    files = (work_file(path, program.encode(), executable=True),)
    packages = (Package("my_turtles", files, "s02/my_turtles"),)
    handed_in = Submission("s02", "09", b"", "s02/my_turtles", problem="No notebook.", packages=packages)
    flags = flags_of(["copies"], submission("s01", {"09.3": source}, "09"), handed_in)
    assert flags["s01"][0].where == "09.3"
    assert flags["s02"][0].where == f"my_turtles/{path}"
