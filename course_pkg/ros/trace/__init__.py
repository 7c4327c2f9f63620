"""The recorder of a node, and what is made of its records: calls, messages, callbacks, bytes on the wire."""
