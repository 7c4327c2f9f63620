"""Finds students' work in home folders. Reads the work with the rights of each student, and stores it."""
