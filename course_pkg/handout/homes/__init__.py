"""Finds students' work in home folders, reads it with the rights of its owner, and stores it."""
