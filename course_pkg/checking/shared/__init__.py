"""Assertions that several chapters use; each chapter passes its own hints."""
