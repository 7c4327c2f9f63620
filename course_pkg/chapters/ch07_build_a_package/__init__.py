"""Chapter 07, build a package in a terminal: its checks, fixtures and example answers."""

TITLE = "Build a package in a terminal"
