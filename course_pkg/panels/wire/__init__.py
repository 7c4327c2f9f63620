"""The wire view: an explanation of each byte of a real call."""
