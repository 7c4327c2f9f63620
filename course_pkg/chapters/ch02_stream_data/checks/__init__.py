"""The checks of chapter 02: a separate node subscribes to the student's topics, and publishes on them."""

from course_pkg.chapters.ch02_stream_data.checks.fixed_rate import count_aloud
from course_pkg.chapters.ch02_stream_data.checks.mirror import a_mirror
from course_pkg.chapters.ch02_stream_data.checks.notice import a_notice
from course_pkg.chapters.ch02_stream_data.checks.two_queues import two_queues
from course_pkg.chapters.ch02_stream_data.checks.watching import watch_a_stream

__all__ = ["a_mirror", "a_notice", "count_aloud", "two_queues", "watch_a_stream"]
