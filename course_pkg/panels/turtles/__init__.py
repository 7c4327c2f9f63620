"""The turtle panel: it draws turtles and their trails from messages on the graph."""
