"""An instructor's class list and Moodle's grading worksheet, and the search for a student's row in them."""
