"""The cells that run before and after an answer of chapter 10 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
import threading
import time
import uuid

import rospy
from course_pkg import join
from course_pkg.srv import Charge, ChargeResponse, DetectCustomer, DetectCustomerResponse
from std_srvs.srv import Trigger, TriggerResponse

node = join("chapter_10")

# %% 10.4 10.5 before
class Shelf:
    def __init__(self, count):
        self.count = count

    def read(self):
        return self.count

    def write(self, count):
        self.count = count

# %% 10.6 before
class NumberedShelf:
    def __init__(self, number, count):
        self.number, self.count = number, count
        self.lock = threading.Lock()
