"""What Linux offers to separate processes: namespaces, bubblewrap, other users, and removed rights."""
