"""Writes the zip file for grading this course on Gradescope."""
