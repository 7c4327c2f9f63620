"""The checks of chapter 13 compile the student's C++ programs in a new folder, and run them."""

from course_pkg.chapters.ch13_cpp.checks.client import patient_client
from course_pkg.chapters.ch13_cpp.checks.cmake_lists import cmake_list_file
from course_pkg.chapters.ch13_cpp.checks.parallel_server import number_server
from course_pkg.chapters.ch13_cpp.checks.server import box_server

__all__ = ["box_server", "cmake_list_file", "number_server", "patient_client"]
