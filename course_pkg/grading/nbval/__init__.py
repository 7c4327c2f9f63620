"""The run of nbval on a submission, which gives feedback and earns no points."""
