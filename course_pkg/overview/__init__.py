"""The progress of a student and the next step, as text, as an output of a notebook, as CSV and as a page.

It is computed from the student's own record of the checks (checking/record.py), and from the predictions. It
is not a grade.
"""
