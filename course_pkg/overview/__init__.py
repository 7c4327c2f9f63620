"""The progress of a student and the next step, for a notebook, a terminal, a table and an HTML page.

It uses the student's own record of the checks (checking/record.py), and the predictions. It is not a grade.
"""
