"""Builds the notebook that is graded: the reference notebook with a student's answers."""
