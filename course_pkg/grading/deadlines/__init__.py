"""Deadlines: the times of submissions, the lateness, and the choice of the attempt that counts."""
