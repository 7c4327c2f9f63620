"""The wire view: a real call, byte by byte."""
