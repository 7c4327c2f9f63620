"""The tools that a build of a program with roscpp needs, and the commands that install missing tools."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

HEADER = "include/ros/ros.h"
LIBRARIES = ("roscpp", "rosconsole", "roscpp_serialization", "rostime", "boost_system", "boost_thread")
# Without this option, the compiler accepts a handler without a return statement; such a handler may crash.
WARNINGS = ("-Werror=return-type",)


def missing_for_cpp() -> str:
    """Return an instruction to install a missing tool for C++ programs, or "" if no tool is missing."""
    if not _compiler_here():
        return _advice(f"No C++ compiler is installed ({compiler()}).", "g++", "compilers")
    if not any((prefix / HEADER).exists() for prefix in prefixes()):
        return _advice("The header files of roscpp are not installed.", "libroscpp-dev", "ros-noetic-roscpp")
    return ""


def compiler() -> str:
    """Return the command of the C++ compiler: the value of CXX, which CMake also uses, or c++."""
    return os.environ.get("CXX") or "c++"


def prefixes() -> list[Path]:
    """Return the installation prefixes of headers and libraries: catkin workspaces, conda, and the system."""
    named = os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    return [
        Path(each) for each in dict.fromkeys([*named, os.environ.get("CONDA_PREFIX", ""), "/usr"]) if each
    ]


def compile_command(source: str, program: str) -> list[str]:
    """Return a command that builds a program from one file with the options of catkin, without CMake."""
    folders: list[str] = []
    for prefix in prefixes():
        if prefix == Path("/usr"):  # The compiler searches /usr without an option.
            continue
        folders += [f"-I{prefix}/include", f"-L{prefix}/lib", f"-Wl,-rpath,{prefix}/lib"]
    libraries = [f"-l{name}" for name in LIBRARIES]
    return [compiler(), "-std=c++17", *WARNINGS, *folders, source, "-o", program, *libraries, "-lpthread"]


def _compiler_here() -> bool:
    return shutil.which(compiler().split()[0]) is not None


def _advice(problem: str, debian: str, conda: str) -> str:
    return (
        f"{problem} On Debian and Ubuntu type: apt-get install --no-install-recommends {debian}; with conda: "
        f"conda install {conda}. Then restart the kernel."
    )
