"""Chapter 09, drive turtles: checks, fixtures, example answers, recordings and programs."""

TITLE = "Drive turtles"
