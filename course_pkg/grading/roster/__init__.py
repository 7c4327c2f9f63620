"""Reads an instructor's class list and Moodle's grading worksheet, and finds the row of a student."""
