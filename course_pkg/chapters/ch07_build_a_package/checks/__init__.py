"""The checks of chapter 07: they build a copy of the student's package, and run its programs."""

from course_pkg.chapters.ch07_build_a_package.checks.client import the_client
from course_pkg.chapters.ch07_build_a_package.checks.cmake_lists import the_build
from course_pkg.chapters.ch07_build_a_package.checks.definition import the_definition, the_second_definition
from course_pkg.chapters.ch07_build_a_package.checks.install_rules import the_install_rules
from course_pkg.chapters.ch07_build_a_package.checks.manifest import the_manifest
from course_pkg.chapters.ch07_build_a_package.checks.on_off import the_on_off_client, the_on_off_server
from course_pkg.chapters.ch07_build_a_package.checks.readme import the_readme
from course_pkg.chapters.ch07_build_a_package.checks.server import the_server

__all__ = [
    "the_build",
    "the_client",
    "the_definition",
    "the_install_rules",
    "the_manifest",
    "the_on_off_client",
    "the_on_off_server",
    "the_readme",
    "the_second_definition",
    "the_server",
]
