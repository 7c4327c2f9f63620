"""Reads the files that were handed in (archives, and notebooks of any form), and returns submissions."""
