"""One run of `course grade`: its selection, its cluster, earlier results, and its output."""
