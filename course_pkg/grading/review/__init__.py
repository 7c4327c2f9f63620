"""Manual review: an instructor's points and comments, a page to enter them, and their use in grades."""
