"""The progress of a student and the next step, as text, notebook output, CSV or HTML page.

The progress is computed from the student's own record of the checks (checking/record.py) and from the
predictions. The progress is not a grade.
"""
