"""Make a process a node: join the graph, create services, publishers and subscriptions, and leave."""
