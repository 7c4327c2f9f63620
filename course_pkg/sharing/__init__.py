"""The student's side of the class view: it sends the results of checks to the teacher's service.

Sharing is on only if COURSE_CLASS_URL contains the address of the service. The check runner then writes each
result into the outbox, a folder in the student's state folder. The course's extension of the Jupyter server
sends the files in the outbox. The kernel itself sends nothing.
"""
