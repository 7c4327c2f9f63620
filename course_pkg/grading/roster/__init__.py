"""The class list of an instructor, Moodle's grading worksheet, and the search for a student's row."""
