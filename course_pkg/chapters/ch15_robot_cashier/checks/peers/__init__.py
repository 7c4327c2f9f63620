"""The nodes that the checks of chapter 15 play for the student's programs, and what these nodes publish."""
