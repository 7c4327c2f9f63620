"""Flags mark work that an instructor should look at. A flag is a hint for a person.

It never changes points.
"""
