"""Chapter 03, choose: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Choose between a topic and a service"
