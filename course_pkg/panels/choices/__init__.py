"""The choices panel: the student chooses an option for each case, and then reads the reasons."""
