"""The cells that run before and after an answer of chapter 12 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
import threading
import time
import uuid

import rosgraph
import rospy
from course_pkg import join
from course_pkg.srv import AddTwoInts, Charge, ChargeResponse
from std_srvs.srv import Trigger, TriggerResponse

node = join("chapter_12")

# %% 12.3 before
def call_within(seconds, proxy, *values):
    results = []

    def call():
        try:
            results.append((proxy(*values), None))
        except rospy.ServiceException as error:
            results.append((None, error))

    thread = threading.Thread(target=call, daemon=True)
    thread.start()
    thread.join(seconds)
    if not results:
        raise TimeoutError(f"no response within {seconds} s")
    response, error = results[0]
    if error:
        raise error
    return response

# %% 12.2 before
class Purse:
    def __init__(self):
        self.taken = []

    def take(self, cents):
        self.taken.append(cents)
