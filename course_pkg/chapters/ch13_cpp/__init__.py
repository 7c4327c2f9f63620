"""Chapter 13, cpp: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Read and build the C++ side"
