"""The prediction panels: the student predicts a result before the run, and then compares both."""
