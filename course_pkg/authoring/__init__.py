"""Tools for authors: run the solutions, and derive the students' notebooks from them."""
