"""The students' edition: its files, its folder and git repository, its zip, and the link to it."""
