"""Reads an instructor's class list and Moodle's grading worksheet, and finds a student's row in them."""
