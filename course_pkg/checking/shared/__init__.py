"""Assertions that the checks of several chapters share. Each chapter passes its own hints."""
