"""Code for the kernel: a module `clock` with the functions of `time`.

A student can replace functions of the module `time`, but not the functions of the new module `clock`.
"""

from __future__ import annotations

UNCHANGED_CLOCK = """
import importlib.machinery
import importlib.util

found = importlib.machinery.BuiltinImporter.find_spec("time")
clock = importlib.util.module_from_spec(found)
found.loader.exec_module(clock)
"""
