"""The request handler and the style sheet that the pages of `course class` and `course review` share."""
