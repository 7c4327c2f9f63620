"""This code runs in the kernel during a check: new threads pause before each line of the student's code.

Without these pauses, a race between two consecutive lines is too rare for a check. During a pause, other
threads run, so two threads can reach the same line.
"""

from __future__ import annotations

SLOW_LINES = """
import threading
import time


class SlowLines:
    pause = 0.0005  # s

    def begin(self):
        threading.settrace(self.enter)

    def end(self):
        threading.settrace(None)

    def enter(self, frame, event, argument):
        return self.wait if frame.f_globals.get("__name__") == "__main__" else None

    def wait(self, frame, event, argument):
        if event == "line":
            time.sleep(self.pause)
        return self.wait


slow_lines = SlowLines()
"""
