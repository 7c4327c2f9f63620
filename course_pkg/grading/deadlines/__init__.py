"""Deadlines: when a submission was handed in, when it was due, how late it is, and which attempt counts."""
