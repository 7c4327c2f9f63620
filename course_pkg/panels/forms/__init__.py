"""Forms: any message type as fields to fill in, whatever is then done with the message."""
