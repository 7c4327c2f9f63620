"""What it takes to build a program against roscpp, and what to type where it is not here."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

HEADER = "include/ros/ros.h"
LIBRARIES = ("roscpp", "rosconsole", "roscpp_serialization", "rostime", "boost_system", "boost_thread")
WARNINGS = ("-Werror=return-type",)  # a handler without a return builds, and crashes or not as it pleases


def missing_for_cpp() -> str:
    """Return what is missing here to build C++ programs, and what to do about it; empty if nothing is."""
    if not _compiler_here():
        return _advice(f"There is no C++ compiler here ({compiler()}).", "g++", "compilers")
    if not any((prefix / HEADER).exists() for prefix in prefixes()):
        return _advice("The headers of roscpp are not here.", "libroscpp-dev", "ros-noetic-roscpp")
    return ""


def compiler() -> str:
    """Return the command of the C++ compiler: CXX, which CMake goes by, too, or c++."""
    return os.environ.get("CXX") or "c++"


def prefixes() -> list[Path]:
    """Return where headers and libraries lie: each catkin workspace, conda's environment, the system."""
    named = os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    return [
        Path(each) for each in dict.fromkeys([*named, os.environ.get("CONDA_PREFIX", ""), "/usr"]) if each
    ]


def compile_command(source: str, program: str) -> list[str]:
    """Return the command that makes `program` of one file, as catkin would: for one, CMake takes too long."""
    folders: list[str] = []
    for prefix in prefixes():
        if prefix == Path("/usr"):  # the compiler looks there by itself
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
