"""Builds the notebook that is graded: the course's solution notebook with a student's answers."""
