"""Hands out the course to students as an edition without solutions, and collects their work."""
