"""Chapter 12, survive trouble: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Survive trouble"
