"""One module for each report; `write(book, out)` writes a report about the grades `book` into `out`."""
