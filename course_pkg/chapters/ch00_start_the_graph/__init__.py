"""Chapter 00, start the graph: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Start the graph"
