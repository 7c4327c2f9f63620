"""Students' work: find it in home folders, read it with the rights of its owner, and store it."""
