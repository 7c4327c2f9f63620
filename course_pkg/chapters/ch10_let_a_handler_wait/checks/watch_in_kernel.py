"""Code for the kernel: a Watch that records a handler's calls, and a Shop that serves the handler."""

from __future__ import annotations

from course_pkg.checking.kernel.unchanged_clock import UNCHANGED_CLOCK

# This code defines the class Shop, which serves the student's handler together with a new Watch.
A_SHOP = (
    UNCHANGED_CLOCK
    + """
import collections
import functools
import threading

import rospy
from course_pkg.srv import DetectCustomer
from std_msgs.msg import UInt32MultiArray

Customer = collections.namedtuple("Customer", "number arrived")


class CountingCondition(threading.Condition):
    waits = 0

    def wait(self, timeout=None):
        self.waits += 1
        return super().wait(timeout)

    def is_held(self):
        return self._is_owned()


class CountingWatch:
    def __init__(self):
        self.changed = CountingCondition()
        self.customers = {}
        self.looks, self.told = 0, False
        self.finders = set()  # threads whose handler has seen a customer
        self.coming = 0  # number of a customer who comes during the next call of next() without the lock
        self.left = False  # whether a handler called next() without the lock after the customer had left

    @property
    def count(self):
        return len(self.customers)

    def receive(self, message):
        with self.changed:
            known, now = self.customers, rospy.Time.now()
            self.customers = {number: known.get(number, Customer(number, now)) for number in message.data}
            self.told = True
            if self.customers.keys() != known.keys():
                self.changed.notify_all()

    def announce(self, number):
        self.coming = number

    def arrive(self):
        with self.changed:
            self.customers = {self.coming: Customer(self.coming, rospy.Time.now())}
            self.coming = 0
            self.changed.notify_all()

    def next(self, after=0):
        self.looks += 1
        customer = min((each for each in self.customers.values() if each.number > after), default=None)
        if self.coming and not customer and not self.changed.is_held():
            self.arrive()  # The handler that called next() cannot see this customer without another call.
        if customer and threading.get_ident() in self.finders and not self.changed.is_held():
            self.left, customer = True, None
        if customer:
            self.finders.add(threading.get_ident())
        return customer

    def handle(self, handler, request):
        self.finders.discard(threading.get_ident())
        return handler(self, request)


class Shop:
    def open(self, handler, counter, service):
        self.watch = CountingWatch()
        self.camera = rospy.Subscriber(counter, UInt32MultiArray, self.watch.receive)
        self.service = rospy.Service(service, DetectCustomer, functools.partial(self.watch.handle, handler))

    def close(self):
        self.camera.unregister()
        self.service.shutdown("checked")


    @property
    def used(self):
        return clock.process_time()  # s of processor time of the kernel


shop = Shop()
"""
)
