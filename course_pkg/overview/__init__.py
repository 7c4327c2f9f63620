"""What a student has done, and what is next: for a notebook, a terminal, a table and a page.

It is made of the student's own record (checking/record.py) and predictions. It is no grade.
"""
