"""A fixture with an IPython kernel that runs a node."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from course_pkg.ros import PrivateMaster
from tests.notebook_kernel import NotebookKernel

SETUP = """
import threading
import rospy
from std_msgs.msg import UInt32
from std_srvs.srv import Trigger
from course_pkg import join
node = join("student")

def ask(name):
    return rospy.ServiceProxy(name, Trigger)().message
"""


@pytest.fixture(scope="module")
def notebook(master: PrivateMaster) -> Iterator[NotebookKernel]:
    """Return a kernel that has called join() in its first cell."""
    with NotebookKernel() as kernel:
        assert not kernel.run(SETUP, "setup").ename
        yield kernel
