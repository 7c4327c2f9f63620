"""The commands that a check runs in its own folders, on the computer of the student's kernel."""
