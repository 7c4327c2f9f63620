"""Every error that the course raises.

CourseError
└── (each subpackage adds its branch below, and to this picture)

A message says what happened, where, and what to do next.
"""

from __future__ import annotations


class CourseError(Exception):
    """The root: `except CourseError` catches whatever the course itself raises."""
