"""Grades one submission in Gradescope's container; `course autograder` writes the zip for it."""
