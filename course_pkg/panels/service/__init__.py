"""The service panel: a form for any service on the graph."""
