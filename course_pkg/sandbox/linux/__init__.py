"""Separate processes from each other on Linux: with namespaces, bubblewrap, users, and fewer privileges."""
