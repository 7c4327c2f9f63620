"""What catkin and pip both read; the rest stands in pyproject.toml.

catkin runs this file with a `setup` of its own and wants name, version and an explicit list.
"""

from pathlib import Path
from xml.etree import ElementTree

from setuptools import setup

HERE = Path(__file__).resolve().parent
PACKAGES = sorted(path.parent for path in HERE.glob("course_pkg/**/__init__.py"))


def names(pattern: str) -> list[str]:
    """Return the files that match `pattern`, relative to this one."""
    return sorted(str(path.relative_to(HERE)) for path in HERE.glob(pattern))


setup(
    name="course_pkg",
    version=ElementTree.parse(HERE / "package.xml").findtext("version"),  # noqa: S314 -- our own file
    packages=[str(folder.relative_to(HERE)).replace("/", ".") for folder in PACKAGES],
    # Whatever lies beside the modules: front ends, settings, locks.
    package_data={
        "course_pkg": sorted(
            str(path.relative_to(HERE / "course_pkg"))
            for path in HERE.glob("course_pkg/**/*")
            if (path.is_file() and path.suffix not in (".pyc", ".py")) or path.name.endswith(".answers.py")
        )
    },
    data_files=[
        ("share/course_pkg", ["package.xml"]),
        ("share/course_pkg/srv", names("srv/*.srv")),
        ("share/course_pkg/launch", names("launch/*.launch")),
    ],
)
