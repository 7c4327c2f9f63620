"""Flags mark work that an instructor should examine. A flag never changes points."""
