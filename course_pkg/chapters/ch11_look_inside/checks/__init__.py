"""The checks of chapter 11: the bytes of TCPROS, sessions, and clients that keep connections open."""

from course_pkg.chapters.ch11_look_inside.checks.connection_header import packed_header
from course_pkg.chapters.ch11_look_inside.checks.exact_read import exact_read
from course_pkg.chapters.ch11_look_inside.checks.known_address import client_with_a_known_address
from course_pkg.chapters.ch11_look_inside.checks.persistent_client import persistent_client
from course_pkg.chapters.ch11_look_inside.checks.sessions import totals_of_sessions
from course_pkg.chapters.ch11_look_inside.checks.socket_call import call_over_a_socket

__all__ = [
    "call_over_a_socket",
    "client_with_a_known_address",
    "exact_read",
    "packed_header",
    "persistent_client",
    "totals_of_sessions",
]
