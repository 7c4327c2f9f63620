"""The topic panel: publish on a topic, receive its messages, and see what happens to each message."""
