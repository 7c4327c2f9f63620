"""A shared installation for all users of a machine, and an installer for machines without internet.

A prefix, such as /opt/ros-services-course, contains:

- versions/ID: one version. A version is complete as soon as it contains installation.json, and it never
  changes after that. It contains `course` (the students' edition), `env` (virtual environment and catkin
  workspace), `completion.bash`
- current: a link to the version that `course` on the PATH starts

`course_pkg/installed.py` decides where a user's own files are.
"""
