"""The shelf of the check: a store in which whoever reads without a lock meets another reader, every time."""

from __future__ import annotations

from course_pkg.examiner import says

TRIGGER = "std_srvs/Trigger"
CALLERS = 50
ONE = 6.0  # s for a call of its own
TEXT = {says("field message must be"): "The message is text: str(...) makes it of a number."}
PATIENCE = 20.0  # s for 50 calls at once, on a machine that is busy

# Fifty handlers at once are fifty threads, and behind the walls of grading there is not room for as many
# stacks of 8 MB. Small ones are enough for a handler.
SMALL_STACKS = """
import threading


class SmallStacks:
    def begin(self):
        self.before = threading.stack_size(512 * 1024)

    def end(self):
        threading.stack_size(self.before)


small_stacks = SmallStacks()
"""

# Whoever reads or writes waits a moment for somebody else to read the same number. Who is kept out by a lock
# cannot come.
A_SHELF = (
    SMALL_STACKS
    + """
import rospy
from std_srvs.srv import Trigger


class CheckedShelf:
    meeting = 0.01

    def __init__(self, count):
        self.count, self.reads, self.turn = count, 0, threading.Condition()

    def read(self):
        with self.turn:
            seen = self.count
            self.reads += 1
            self.turn.notify_all()
            self.meet()
        return seen

    def write(self, count):
        with self.turn:
            self.meet()
            self.count = count

    def meet(self):
        so_far = self.reads
        self.turn.wait_for(lambda: self.reads > so_far, self.meeting)


class CheckedShop:
    def open(self, kind, count, services, *others):
        small_stacks.begin()
        self.shelf = CheckedShelf(count)
        self.one = kind(self.shelf, *others)
        handlers = [(name, getattr(self.one, handler)) for name, handler in services.items()]
        self.services = [rospy.Service(name, Trigger, handler) for name, handler in handlers]

    def close(self):
        small_stacks.end()
        for service in self.services:
            service.shutdown("checked")


checked_shop = CheckedShop()
"""
)
