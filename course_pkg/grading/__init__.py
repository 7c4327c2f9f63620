"""Grades submissions.

A sandbox runs the reference notebook with the student's answers, and a process outside the sandbox checks the
results.
"""
