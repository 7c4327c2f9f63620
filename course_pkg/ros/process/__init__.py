"""Start, supervise and end processes; after the end, no process and no temporary file remains."""
