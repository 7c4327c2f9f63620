"""The chapters: each folder contains all files of a chapter except its notebook."""
