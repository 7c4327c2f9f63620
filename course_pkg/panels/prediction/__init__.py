"""Predictions: the student answers before the run, and compares the answer with the result."""
