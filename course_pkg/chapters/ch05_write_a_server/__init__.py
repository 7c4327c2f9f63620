"""Chapter 05, write a server: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Write a server"
