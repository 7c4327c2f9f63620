"""An attack in the build of a package earns no points, and does not change the next result."""

from __future__ import annotations

import re
import textwrap
import time
from collections.abc import Iterator

import pytest

from course_pkg.checking.fixtures import around
from course_pkg.checking.parts import find
from course_pkg.sandbox.job import PartJob, PartResult
from course_pkg.sandbox.worker_client import SandboxWorker
from tests.grading.packages import NO_SERVER, SERVER, my_geometry, work_files
from tests.sandbox.attacks import BUILD, BUILD_SLOW
from tests.support import usual

pytestmark = [pytest.mark.usefixtures("sandbox"), pytest.mark.timeout(400)]
CHECK = "07.4"
BEFORE, AFTER = around(CHECK)
LISTS = "CMakeLists.txt"
FORGED_TYPE = """\
cmake_minimum_required(VERSION 3.0.2)
project(my_geometry)
find_package(catkin REQUIRED)
catkin_package()
set(folder ${CATKIN_DEVEL_PREFIX}/lib/python3/dist-packages/my_geometry)
file(WRITE ${folder}/__init__.py "")
file(WRITE ${folder}/srv/__init__.py "class geometry:\\n    _md5sum = 'MD5'\\n")
add_custom_target(my_geometry_programs ALL
  COMMAND mkdir -p ${folder}/srv && echo "class geometry: _md5sum = 'MD5'" > ${folder}/srv/__init__.py)
# message_runtime
"""

# Other packages read only the first line with the dependencies.
APPENDS = """
set(configuration ${CATKIN_DEVEL_PREFIX}/share/my_geometry/cmake/my_geometryConfig.cmake)
file(APPEND ${configuration} "set(depends message_runtime)\\n")
"""


@pytest.fixture(scope="module")
def worker() -> Iterator[SandboxWorker]:
    """Run one sandbox worker, which all tests of this module use."""
    with SandboxWorker() as started:
        yield started


def examined(worker: SandboxWorker, changes: dict[str, str], check: str = CHECK) -> PartResult:
    """Change the files of the solution's package, run a check of this package, and return the result."""
    files = work_files(my_geometry(changes))
    return worker.run(PartJob(check, BEFORE, (), AFTER, 1, find(check).deadline, files=files))


def points(result: PartResult) -> int:
    """Return the points in the result's record, or 0 if the result has no record."""
    return int((result.record or {}).get("points", 0))


def attacked(attack: str) -> str:
    """Return the solution's CMakeLists.txt with the lines of an attack."""
    text = my_geometry()[LISTS].decode()
    end = text.index("\n", text.index("catkin_package(")) + 1
    return text[:end] + textwrap.dedent(attack) + text[end:]


def attack_wrong(worker: SandboxWorker, attack: str) -> PartResult:
    """Check a package that contains an attack and a wrong server.

    Assert that the package earns no points.
    """
    result = examined(worker, {LISTS: attacked(attack), SERVER: NO_SERVER})
    assert points(result) == 0, result
    assert result.record or result.ending
    return result


@pytest.mark.parametrize("attack", usual(3, BUILD))
def test_an_attack_in_a_build_earns_no_points(worker: SandboxWorker, attack: str) -> None:
    """A wrong server with an attack in its build earns no points."""
    attack_wrong(worker, attack)


def test_the_next_package_earns_its_points(worker: SandboxWorker) -> None:
    """After all attacks of this file, the same worker accepts a right package."""
    assert points(examined(worker, {})) == 3


@pytest.mark.slow
@pytest.mark.parametrize("attack", BUILD)
def test_no_attack_in_a_build_harms_the_next_package(worker: SandboxWorker, attack: str) -> None:
    """After each attack, the same worker accepts a right package."""
    attack_wrong(worker, BUILD[attack])
    assert points(examined(worker, {})) == 3


@pytest.mark.slow
@pytest.mark.parametrize("attack", BUILD_SLOW)
def test_a_build_that_never_ends_is_ended(worker: SandboxWorker, attack: str) -> None:
    """An endless build is killed after its time limit."""
    began = time.monotonic()
    attack_wrong(worker, BUILD_SLOW[attack])
    assert time.monotonic() - began < find(CHECK).deadline + 60.0
    assert points(examined(worker, {})) == 3


def test_a_forged_type_earns_no_points(worker: SandboxWorker) -> None:
    """A class with a forged MD5 sum earns no points."""
    from course_pkg.chapters.ch07_build_a_package.checks.packages import geometry_class

    forged = FORGED_TYPE.replace("MD5", geometry_class()._md5sum)
    result = examined(worker, {LISTS: forged}, "07.3")
    assert points(result) == 0


def test_a_second_line_with_dependencies_earns_no_points(worker: SandboxWorker) -> None:
    """A line that CMakeLists.txt appends to the configuration does not replace CATKIN_DEPENDS."""
    text = re.sub(r"CATKIN_DEPENDS[^)]*", "", my_geometry()[LISTS].decode())
    report = examined(worker, {LISTS: text + APPENDS}, "07.3").report
    assert report is not None
    (failed,) = [each.text for each in report.assertions if not each.holds]
    assert failed == ("every package that uses this package also depends on message_runtime, rospy, std_msgs")
    assert report.points == 2
