"""The turtle panel: turtles and their trails, from the messages on the graph."""
