"""The timeline panel: the events of a recording, and which node waited for which."""
