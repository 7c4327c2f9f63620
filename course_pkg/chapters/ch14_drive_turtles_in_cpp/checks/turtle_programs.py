"""14.1 to 14.6: the programs of chapter 09 in C++, with the checks of chapter 09."""

from __future__ import annotations

from course_pkg.chapters.ch09_drive_turtles.checks.follow import FOLLOW_GOALS, follows
from course_pkg.chapters.ch09_drive_turtles.checks.improved import IMPROVED_GOALS, is_improved
from course_pkg.chapters.ch09_drive_turtles.checks.launch_file import COURSE_PROGRAMS, LaunchFile, launches
from course_pkg.chapters.ch09_drive_turtles.checks.rate import RATE_GOALS, changes_its_rate
from course_pkg.chapters.ch09_drive_turtles.checks.spawn import SPAWN_GOALS, spawns
from course_pkg.chapters.ch09_drive_turtles.checks.toggle import TOGGLE_GOALS, toggles
from course_pkg.chapters.ch14_drive_turtles_in_cpp.checks.cpp_program import cpp
from course_pkg.checking import CheckContext, part

SPAWN = cpp("spawn_turtle")
TOGGLE = cpp("pubvel_toggle")
RATE = cpp("pubvel_toggle_plus")
IMPROVED = cpp("improved_pubvel_toggle")
FOLLOW = cpp("spawn_turtle_plus")
LAUNCH = LaunchFile(IMPROVED, FOLLOW)
# The whole check may take up to this time in s; on a busy machine, the compiler may need 90 s.
DEADLINE = 150.0


@part(
    "14.1",
    points=2,
    goal=(
        "Write spawn_turtle.cpp: wait at most 5 s for /spawn, and end with exit status 1 if no turtle "
        "was spawned."
    ),
    needs=[f"file:{SPAWN.path}"],
    deadline=DEADLINE,
    start=f"%%writefile {SPAWN.path}\n...",
    goals=SPAWN_GOALS,
)
def wait_and_spawn(context: CheckContext) -> None:
    """Compile the program, and check it in the same way as in chapter 09."""
    spawns(context, SPAWN)


@part(
    "14.2",
    points=2,
    goal="Write pubvel_toggle.cpp: publish 2 velocities per second, and offer /toggle_forward.",
    needs=[f"file:{TOGGLE.path}"],
    deadline=DEADLINE,
    start=f"%%writefile {TOGGLE.path}\n...",
    goals=TOGGLE_GOALS,
)
def toggle_direction(context: CheckContext) -> None:
    """Compile the program, and check it in the same way as in chapter 09."""
    # A program that calls ros::spinOnce() in its loop handles only two calls per second.
    toggles(context, TOGGLE, pairs=(8, 20))


@part(
    "14.3",
    points=3,
    goal="Write pubvel_toggle_plus.cpp: offer /toggle_forward and /change_rate.",
    needs=[f"file:{RATE.path}"],
    deadline=DEADLINE,
    start=f"%%writefile {RATE.path}\n...",
    goals=RATE_GOALS,
)
def change_the_rate(context: CheckContext) -> None:
    """Compile the program, and check it in the same way as in chapter 09."""
    changes_its_rate(context, RATE)


@part(
    "14.4",
    points=3,
    goal=(
        "Write improved_pubvel_toggle.cpp: offer /toggle_forward, /change_rate, "
        "/change_speed and /start_stop."
    ),
    needs=[f"file:{IMPROVED.path}"],
    deadline=DEADLINE,
    start=f"%%writefile {IMPROVED.path}\n...",
    goals=IMPROVED_GOALS,
)
def change_speed_and_stop(context: CheckContext) -> None:
    """Compile the program, and check it in the same way as in chapter 09."""
    is_improved(context, IMPROVED)


@part(
    "14.5",
    points=3,
    goal=(
        "Write spawn_turtle_plus.cpp: spawn MyTurtle, call /toggle_forward, set the "
        "speed to 2 m/s, and publish the velocities of turtle1 for MyTurtle."
    ),
    needs=[f"file:{FOLLOW.path}"],
    deadline=DEADLINE,
    start=f"%%writefile {FOLLOW.path}\n...",
    goals=FOLLOW_GOALS,
)
def bring_a_second_turtle(context: CheckContext) -> None:
    """Compile the program, and check it in the same way as in chapter 09."""
    follows(context, FOLLOW)


@part(
    "14.6",
    points=1,
    goal=(
        "Write exercise3.launch: always start the simulator and the driver, but start "
        "spawn_turtle_plus only with addturtle:=true."
    ),
    needs=[f"file:{LAUNCH.path}"],
    deadline=60.0,
    start=f"%%writefile {LAUNCH.path}\n...",
    runs=COURSE_PROGRAMS,
)
def two_turtles_or_one(context: CheckContext) -> None:
    """Check the launch file in the same way as in chapter 09."""
    launches(context, LAUNCH)
