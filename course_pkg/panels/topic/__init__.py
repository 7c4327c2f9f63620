"""The topic panel: publish on a topic, hear what it carries, and see what becomes of messages."""
