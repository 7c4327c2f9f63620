"""Chapter 06, write a client: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Write a client"
