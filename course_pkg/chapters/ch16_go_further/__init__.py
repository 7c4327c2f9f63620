"""Chapter 16, go further: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Go further"
