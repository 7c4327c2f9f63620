"""Chapter 08, use existing services: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Use the services that already exist"
