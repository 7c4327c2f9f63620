"""Chapter 14: the turtle programs in C++, callbacks and spinners."""

TITLE = "Drive turtles in C++"
