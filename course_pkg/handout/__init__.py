"""Creates an edition of the course without solutions for students, and collects the students' work."""
