"""Objects of the check runner that the student's kernel can use through proxies.

The proxies are in kernel/object_proxy.py. Each call of a proxy's method runs a method of the real object, in
a thread of the check runner. Therefore, student code that changes a proxy cannot change the data that the
check has recorded. The check also decides when a call returns.
"""

from course_pkg.checking.placed.declared import remote

__all__ = ["remote"]
