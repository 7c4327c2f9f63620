"""One run of `course grade`: its selection, its cluster, the results that it keeps, and its output."""
