"""Grading: what was handed in is placed into the reference, run behind walls, and examined from outside."""
