"""The turtle panel: turtles and their trails, from what the graph says."""
