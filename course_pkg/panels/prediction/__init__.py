"""Predictions: commit to an answer before the run, and compare."""
