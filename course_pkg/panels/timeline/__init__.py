"""The timeline panel: the events of a recording, and the times during which nodes waited for each other."""
