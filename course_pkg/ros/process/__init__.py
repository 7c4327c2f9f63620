"""Start, supervise and end processes, and delete their temporary files."""
