"""Marks work that an instructor should look at. A flag is for a person: it never changes points."""
