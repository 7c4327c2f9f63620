"""The prediction panels: the student predicts the result of a program, and then sees the real result."""
