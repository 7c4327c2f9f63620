"""Chapter 02, stream data: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Stream data with a topic"
