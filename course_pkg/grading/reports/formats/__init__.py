"""One module for each report; `write(book, out)` writes the grades `book` into files in the folder `out`."""
