"""Reads handed-in files (archives, and notebooks in any format), and returns submissions."""
