"""Make a process a node, and create services, publishers and subscriptions."""
