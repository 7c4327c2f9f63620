"""Choices: many cases, the same few options, a reason for each."""
