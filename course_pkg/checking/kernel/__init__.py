"""The part of a check that runs in the student's kernel: it reads and runs the student's code."""
