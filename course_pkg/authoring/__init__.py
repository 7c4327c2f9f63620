"""Tools for authors: they run the solutions, and derive the students' notebooks from them."""
