"""Build the reference notebook with a student's answers: find the cell of each answer."""
