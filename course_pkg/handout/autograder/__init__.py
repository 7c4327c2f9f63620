"""Writes the zip with which Gradescope grades submissions by this course."""
