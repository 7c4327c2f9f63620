"""Grades submissions.

A sandbox runs the course's solution notebook with the student's answers in place of the solutions, and a
process outside the sandbox checks the results.
"""
