"""One run of `course grade`: the selection, the cluster, the results of earlier runs, and the output."""
