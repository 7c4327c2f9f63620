"""Grading.

A student's answers are placed into the reference notebook, which runs in a sandbox and is checked from
outside.
"""
