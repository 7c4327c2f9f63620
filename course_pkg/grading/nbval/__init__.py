"""Runs a submission with nbval, which gives feedback but no points."""
