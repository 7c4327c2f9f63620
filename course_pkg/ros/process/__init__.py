"""Start, supervise and end processes; no process or file remains after the end."""
