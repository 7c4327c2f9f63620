"""The check's own part of the graph: its node, servers, publishers and subscriptions."""
