"""Chapter 11, look inside a call: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Look inside a call"
