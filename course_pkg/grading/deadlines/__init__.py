"""Deadlines: finds the times of submissions, computes the lateness, and chooses the attempt that counts."""
