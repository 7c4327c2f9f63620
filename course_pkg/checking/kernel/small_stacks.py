"""Kernel code: threads with small stacks, for checks that run many handlers at the same time.

Fifty handlers at the same time need fifty threads. With the default stack size of 8 MB, these threads need
more memory than a sandbox has.
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
