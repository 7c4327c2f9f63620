"""Chapter 10, Let a handler wait: waiting handlers, conditions, threads, locks, races and deadlocks."""

TITLE = "Let a handler wait"
