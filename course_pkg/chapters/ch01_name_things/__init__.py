"""Chapter 01, name things: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Name things and find them"
