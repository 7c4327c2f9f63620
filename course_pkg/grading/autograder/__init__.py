"""Grades one submission in the container of an autograder of Gradescope. `course autograder` makes its zip."""
