"""Contains the settings that both catkin and pip read; pyproject.toml contains all other settings.

When catkin runs this file, a function of catkin replaces `setup`. This function needs the name, the version
and a list of packages.
"""

from pathlib import Path
from xml.etree import ElementTree

from setuptools import setup
from setuptools.command.build_py import build_py

HERE = Path(__file__).resolve().parent
PACKAGES = sorted(path.parent for path in HERE.glob("course_pkg/**/__init__.py"))


def names(pattern: str) -> list[str]:
    """Return the files that match `pattern`, relative to the folder of this file."""
    return sorted(str(path.relative_to(HERE)) for path in HERE.glob(pattern))


class BuildWithoutAnswers(build_py):
    """Builds the package without the example answers, which students must not see."""

    def find_package_modules(self, package: str, package_dir: str) -> list[tuple[str, str, str]]:
        """Return (package, module, file) for every module except `answers`."""
        found = super().find_package_modules(package, package_dir)
        return [module for module in found if module[1] != "answers"]


setup(
    name="course_pkg",
    version=ElementTree.parse(HERE / "package.xml").findtext("version"),  # noqa: S314 -- our own file
    packages=[str(folder.relative_to(HERE)).replace("/", ".") for folder in PACKAGES],
    cmdclass={"build_py": BuildWithoutAnswers},
    # These are the files that are not Python modules, such as front ends, settings and lock files.
    package_data={
        "course_pkg": sorted(
            str(path.relative_to(HERE / "course_pkg"))
            for path in HERE.glob("course_pkg/**/*")
            if path.is_file() and path.suffix not in (".pyc", ".py")
        )
    },
    data_files=[
        ("share/course_pkg", ["package.xml"]),
        ("share/course_pkg/srv", names("srv/*.srv")),
        ("share/course_pkg/launch", names("launch/*.launch")),
    ],
)
