"""The topic panel: it publishes and receives messages, and explains the result for each message."""
