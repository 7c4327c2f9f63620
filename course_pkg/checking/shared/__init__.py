"""Assertions that several chapters use; each chapter passes its own hints.

Each chapter passes its own hints to these shared checks.
"""
