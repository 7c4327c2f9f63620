"""The choices panel: the student chooses one of a few options for each case, and then reads the reasons."""
