"""Chapter 15, robot cashier: its checks, fixtures, example answers, recordings and programs."""

TITLE = "Build the robot cashier"
