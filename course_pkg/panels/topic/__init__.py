"""The topic panel: it publishes and receives messages, and explains what happens to each message."""
