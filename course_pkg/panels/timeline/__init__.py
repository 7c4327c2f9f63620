"""The timeline panel: the events of a recording, and the times that nodes waited for each other."""
