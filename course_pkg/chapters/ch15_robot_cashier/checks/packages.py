"""The package of chapter 15.

If the student has not written a file, the check uses the course's version of this file.
"""

from __future__ import annotations

from course_pkg.chapters.ch07_build_a_package.checks.program import Program
from course_pkg.checking.shared.catkin_package import Package

MANIFEST = """\
<?xml version="1.0"?>
<package format="2">
  <name>my_cashier</name>
  <version>0.1.0</version>
  <description>A robot cashier.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <exec_depend>course_pkg</exec_depend>
  <exec_depend>rospy</exec_depend>
</package>
"""
LISTS = """\
cmake_minimum_required(VERSION 3.0.2)
project(my_cashier)
find_package(catkin REQUIRED)
catkin_package()
"""
# This program starts a node of the course instead of a missing node of the student.
STAND_IN = """\
#!/usr/bin/env python3
from course_pkg.chapters.ch15_robot_cashier.programs.{name} import main

if __name__ == "__main__":
    main()
"""
LAUNCH = "launch/cashier.launch"
# NODES are the names of the package's scripts.
NODES = ("vision", "customer_detector", "robot_cashier", "till")

MY_CASHIER = Package(
    "my_cashier",
    {
        "package.xml": MANIFEST,
        "CMakeLists.txt": LISTS,
        **{f"scripts/{name}.py": STAND_IN.format(name=name) for name in NODES},
    },
)


def program(name: str) -> Program:
    """Return the script `name` of the package; `name` does not include ".py"."""
    return Program(f"scripts/{name}.py", name)


def file_of(name: str) -> str:
    """Return the path of the script `name` in the workspace."""
    return MY_CASHIER.path(f"scripts/{name}.py")


def start_of(name: str, comment: str = "...") -> str:
    """Return the text of the notebook cell in which the student begins to write the script `name`."""
    return f"%%writefile {file_of(name)}\n{comment}"
