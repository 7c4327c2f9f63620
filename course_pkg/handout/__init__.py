"""Hand out the course to students as an edition without solutions, and collect their work."""
