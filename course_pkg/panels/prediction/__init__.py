"""The prediction panels: the student predicts a result, and then compares it with the run."""
