"""This code runs in the kernel during a check: new threads get small stacks, to save memory.

Fifty handlers that run at the same time need fifty threads. With the default stack size of 8 MB, these
threads need more memory than a sandbox has.
"""

from __future__ import annotations

SMALL_STACKS = """
import threading


class SmallStacks:
    def begin(self):
        self.before = threading.stack_size(512 * 1024)

    def end(self):
        threading.stack_size(self.before)


small_stacks = SmallStacks()
"""
