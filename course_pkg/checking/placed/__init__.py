"""Objects that a check places into the student's kernel: they stay in the check runner.

The kernel gets a proxy (kernel/object_proxy.py). Each call of a method of the proxy runs a method of the real
object, in a thread of the check runner. So student code that changes the proxy cannot change the data that
the check has recorded, and the check decides when a call returns.
"""

from course_pkg.checking.placed.declared import remote

__all__ = ["remote"]
