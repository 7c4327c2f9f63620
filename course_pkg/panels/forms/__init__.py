"""Forms in which a student fills in the fields of any message type."""
