"""The checks of chapter 09: bytes that a student writes and reads, and connections that are kept."""

from course_pkg.examiner.checks.chapter_09.keeping import a_connection_that_comes_back
from course_pkg.examiner.checks.chapter_09.packing import pack_a_header, read_exactly
from course_pkg.examiner.checks.chapter_09.remembering import an_address_that_is_kept
from course_pkg.examiner.checks.chapter_09.sessions import a_total_for_each
from course_pkg.examiner.checks.chapter_09.sockets import a_call_by_socket

__all__ = [
    "a_call_by_socket",
    "a_connection_that_comes_back",
    "a_total_for_each",
    "an_address_that_is_kept",
    "pack_a_header",
    "read_exactly",
]
