"""Reads submitted files (archives, and notebooks in any format), and returns submissions."""
