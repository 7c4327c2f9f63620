"""The students' edition: its files, its folder with a git repository, and its zip file."""
