"""The checks of chapter 00: read the graph, call a service, receive from a topic."""

from course_pkg.chapters.ch00_start_the_graph.checks.graph_names import read_the_graph
from course_pkg.chapters.ch00_start_the_graph.checks.missed_numbers import count_what_was_missed
from course_pkg.chapters.ch00_start_the_graph.checks.volume import ask_a_question

__all__ = ["ask_a_question", "count_what_was_missed", "read_the_graph"]
