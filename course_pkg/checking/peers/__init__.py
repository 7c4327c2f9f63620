"""The objects of a check on the graph: its node, servers, publishers and subscriptions."""
