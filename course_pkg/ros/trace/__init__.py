"""Record what nodes do (calls, messages, callbacks), and combine the records of several nodes."""
