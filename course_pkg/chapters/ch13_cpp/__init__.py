"""Chapter 13, C++: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Read and build the C++ side"
