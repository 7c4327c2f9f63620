"""One module for each report; `write(book, out)` writes the report into the folder `out`."""
