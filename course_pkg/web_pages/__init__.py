"""What the pages of `course class` and `course review` share, and the style sheet below that of each page."""
