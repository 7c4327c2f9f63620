"""The plot: measured data as lines, dots or bars."""
