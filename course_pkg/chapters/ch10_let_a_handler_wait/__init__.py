"""Chapter 10, let a handler wait: waiting handlers, conditions, threads, locks, races and deadlocks."""

TITLE = "Let a handler wait"
