"""From solutions, which are written and run by an author, to the notebooks that students get."""
