"""The timeline panel: the events of a recording, and the waits between nodes."""
