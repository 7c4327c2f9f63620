"""Grading.

Grades submissions: a sandbox runs the reference notebook with the student's answers, and a process outside
checks the results.
"""
