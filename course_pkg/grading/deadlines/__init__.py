"""Deadlines: the times of submissions, how late they are, and the choice of the attempt that counts."""
