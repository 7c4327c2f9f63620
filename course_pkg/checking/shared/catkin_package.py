"""A check's copy of a student's catkin package, built in a separate folder, and the programs of this copy.

If the student has not written a file, the check adds the course's version of this file. Therefore, one file
can be examined before the student has written the other files. In grading, files can also be missing, because
a submission contains only the notebook's cells.
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass, replace

from course_pkg.checking.commands.folder import Folder, Running
from course_pkg.checking.context import CheckContext
from course_pkg.checking.plain_values import Message
from course_pkg.checking.result import Finished
from course_pkg.errors import CheckError
from course_pkg.workspace import Fault, explain
from course_pkg.workspace.fault import locate

BUILDS = "catkin_make builds the package"
# The limits are the CPU time in s and the size of a file in KiB. A sandbox has separate limits for these
# values.
LIMITS = "ulimit -t 20 -f 60000 2> /dev/null"
# This is the time limit of the build in s. A build takes 3 s of CPU time, or 6 s on a machine with two cores
# and a load average of 9.
BUILD = 50.0
OWN = "own"  # This folder contains the check's own files; cp -n does not replace the student's files.
FILL = f"mkdir -p src {OWN} && chmod -R +x {OWN} && cp -rn {OWN}/. src/ && rm -rf {OWN}"
SETUP = "devel/setup.bash"
# With this path, ROS finds the packages in `src` without a build; these packages contain only scripts.
IN_SRC = 'export ROS_PACKAGE_PATH="$PWD/src:$ROS_PACKAGE_PATH"\n'
# Without -j2, catkin_make would set a load limit, and make would wait while the machine is busy.
CATKIN_MAKE = "catkin_make -j2"


@dataclass(frozen=True)
class Package:
    """A package for exercises: its name, and the check's own version of each file."""

    name: str
    files: Mapping[str, str]

    @property
    def folder(self) -> str:
        """Return the path of the package's folder in the workspace."""
        return f"src/{self.name}"

    def path(self, file: str) -> str:
        """Return the path of a file of the package in the workspace."""
        return f"{self.folder}/{file}"


class BuiltPackage:
    """A built copy of a package in the check's own workspace."""

    def __init__(self, folder: Folder, package: Package) -> None:
        self.folder = folder
        self.package = package

    def run(self, line: str, *, within: float = 10.0, worded: str = "", setup: str = SETUP) -> Finished:
        """Run a line of bash after `source devel/setup.bash`; return its result.

        The time limit is `within` (s).

        A report shows `worded` instead of the line, if `worded` is given.
        """
        return self.folder.command("bash", "-c", f". {setup} && {line}", within=within, worded=worded or line)

    def start(self, line: str, *, worded: str = "", setup: str = SETUP) -> Running:
        """Start a command that continues to run, such as `rosrun PACKAGE PROGRAM`; returns a context manager.

        A report shows `worded` instead of the command, if `worded` is given.
        """
        return self.folder.start("bash", "-c", f". {setup} && exec {line}", worded=worded or line)

    def md5(self, type_name: str, request: Message = None) -> tuple[str, str]:
        """Import a service type in Python; return (its MD5 sum, ""), or ("", the error output).

        If `request` is given, the type must also serialise this request correctly. Its fields have to be
        numbers.
        """
        line = f"from {self.package.name}.srv import {type_name}; print({type_name}._md5sum)"
        values = [] if request is None else [getattr(request, name) for name in request.__slots__]
        body = io.BytesIO()
        if request is not None:
            request.serialize(body)
        sends = f"import io; b = io.BytesIO(); {type_name}._request_class(*{values}).serialize(b)"
        code = line if request is None else f"{line}; {sends}; print(b.getvalue().hex())"
        done = self.folder.command(
            "bash", "-c", f". {SETUP} && python3 -c '{code}'", worded=f"python3 -c '{line}'"
        )
        md5, _, sent = done.out.strip().partition("\n")
        right = done.status == 0 and sent == body.getvalue().hex()
        return (md5, "") if right else ("", (done.out + done.err).strip())


def built(
    context: CheckContext,
    package: Package,
    *,
    examined: str,
    alone: bool = False,
    drawn: Mapping[str, str] | None = None,
    within: float = BUILD,
) -> BuiltPackage:
    """Build a copy of the student's package, and assert that the build succeeds.

    If `alone` is true, only the file `examined` comes from the student. `drawn` contains files that replace
    the student's files. The keys are paths in the package. These files have random content, so a student's
    CMakeLists.txt cannot already contain it. Raises CheckError if the build takes longer than the time limit
    `within` (s). A build with C++ needs more time than the default.
    """
    own = _own_files(package, examined)
    replaced = {package.path(file): text for file, text in (drawn or {}).items()}
    files = [package.path(examined) if alone else package.folder]
    folder = context.folder(files=files, texts={**own, **replaced})
    build = run_catkin_make(folder, f"{LIMITS}; {FILL} &&", "-DCATKIN_ENABLE_TESTING=OFF", within=within)
    if build.status != 0:
        _fails_to_build(context, package, f"{build.out}\n{build.err}", examined)
    context.require(BUILDS, holds=True)
    return BuiltPackage(folder, package)


def run_catkin_make(folder: Folder, before: str, options: str = "", *, within: float) -> Finished:
    """Run catkin_make in the folder `folder` after the bash commands `before`, such as "ulimit -t 6;".

    Raises CheckError if catkin_make takes longer than the time limit `within` (s).
    """
    line = f"{before} exec {CATKIN_MAKE} {options}"
    build = folder.command("bash", "-c", line, within=within, worded="catkin_make")
    if build.status is None:
        raise CheckError(
            f"catkin_make had not finished after {build.took:.0f} s. The machine is busy, or a command in "
            "CMakeLists.txt never ends. Run this cell again."
        )
    return build


def copied(context: CheckContext, package: Package, *, examined: str, alone: bool = False) -> BuiltPackage:
    """Copy a package that needs no build, because it contains only Python programs and launch files.

    rosrun and roslaunch find the package's programs in `src`, as in a built workspace. If `alone` is true,
    only the file `examined` comes from the student.
    """
    files = [package.path(examined) if alone else package.folder]
    folder = context.folder(files=files, texts={**_own_files(package, examined), SETUP: IN_SRC})
    folder.command("bash", "-c", FILL)
    return BuiltPackage(folder, package)


def _own_files(package: Package, examined: str) -> dict[str, str]:
    """Return the check's own version of each file except the file `examined`; the keys are paths.

    If the result contained the file `examined`, a student's CMakeLists.txt could use the check's version.
    """
    return {f"{OWN}/{package.name}/{file}": text for file, text in package.files.items() if file != examined}


def _fails_to_build(context: CheckContext, package: Package, printed: str, examined: str) -> None:
    fault = explain(printed) or _unexplained(printed)
    if fault.file.endswith("package.xml") and examined == "package.xml":
        fault = locate(fault, context.source(f"file:{package.path(examined)}"))
    if not fault.file:
        fault = replace(fault, file=f"{package.name}/{examined}")
    context.fail(
        BUILDS, expected="a successful build", actual=f"{fault.place}: {fault.problem}", hint=fault.remedy
    )


def _unexplained(printed: str) -> Fault:
    lines = [line.strip() for line in printed.strip().splitlines() if line.strip()]
    return Fault(
        "catkin_make failed", f"Read the end of the output of catkin_make: {' / '.join(lines[-3:])}."
    )
