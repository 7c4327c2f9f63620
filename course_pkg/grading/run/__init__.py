"""One run of `course grade`: its selection, its cluster, the results that stay, and its output."""
