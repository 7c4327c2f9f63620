"""Reads what was handed in (archives, names, notebooks in any state), and returns submissions."""
