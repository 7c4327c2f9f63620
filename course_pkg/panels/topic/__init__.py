"""The topic panel: it publishes and receives messages, and shows which nodes got a published message."""
