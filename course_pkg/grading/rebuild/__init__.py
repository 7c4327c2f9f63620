"""Builds the notebook to grade: the reference notebook with a student's answers."""
