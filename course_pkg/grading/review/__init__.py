"""Manual review: an instructor enters points and comments, and the course adds them to the grades."""
