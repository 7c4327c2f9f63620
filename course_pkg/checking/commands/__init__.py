"""The commands that a check runs in folders of its own, on the computer of the student's kernel."""
