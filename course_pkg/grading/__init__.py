"""Place a student's answers into the reference notebook, run it in a sandbox, and check it from outside."""
