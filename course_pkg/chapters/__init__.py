"""The chapters: a folder for each, with everything that belongs to it except its notebook."""
