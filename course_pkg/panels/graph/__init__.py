"""The graph panel: a picture of nodes, topics and services."""
