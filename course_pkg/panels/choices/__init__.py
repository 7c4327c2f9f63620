"""Choices: many cases with the same few options, and a reason for each case."""
