"""The class list of an instructor, Moodle's grading worksheet, and which submission belongs to which row."""
