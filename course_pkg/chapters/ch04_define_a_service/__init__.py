"""Chapter 04, define a service: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Define a service"
