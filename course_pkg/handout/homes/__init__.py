"""Finds students' work in home folders, reads it with the rights of each student, and stores it."""
