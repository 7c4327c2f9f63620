"""The bytes of real calls, recorded between a client and a server."""
