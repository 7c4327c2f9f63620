"""Objects of the check runner that the student's kernel can use through proxies.

The proxies are in kernel/object_proxy.py. Each call of a proxy's method runs a method of the real object, in
a thread of the check runner. Student code that changes a proxy therefore cannot change the data of the check.
The check also decides when a call returns.
"""

from course_pkg.checking.placed.declared import remote

__all__ = ["remote"]
