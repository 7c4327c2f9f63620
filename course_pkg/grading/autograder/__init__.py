"""Grades one submission in Gradescope's container."""
