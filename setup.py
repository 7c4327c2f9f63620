"""What catkin and pip both read; the rest stands in pyproject.toml.

catkin runs this file with a `setup` of its own and wants name, version and an explicit list.
"""

from pathlib import Path
from xml.etree import ElementTree

from setuptools import setup

HERE = Path(__file__).resolve().parent

setup(
    name="course_pkg",
    version=ElementTree.parse(HERE / "package.xml").findtext("version"),
    packages=[
        "course_pkg",
        "course_pkg.authoring",
        "course_pkg.examiner",
        "course_pkg.examiner.checks",
        "course_pkg.graph",
        "course_pkg.interfaces",
        "course_pkg.lab",
        "course_pkg.nodes",
        "course_pkg.panels",
        "course_pkg.provision",
    ],
)
