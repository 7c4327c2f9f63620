"""Processes: start, supervise and end them, so that nothing is left behind."""
