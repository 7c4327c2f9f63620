"""Runs a submission with nbval; this gives feedback, but no points."""
