"""Review by hand: an instructor's points and comments, a page to enter them, and how they are applied."""
