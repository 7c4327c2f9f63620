"""Grades submissions.

A sandbox runs the course's solution notebook, in which the student's answers replace the solutions. A process
outside the sandbox checks the results.
"""
