"""One module for each report; `write(book, out)` writes it below the folder `out`."""
