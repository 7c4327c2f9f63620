"""Forms: the fields of any message type, to be filled in."""
