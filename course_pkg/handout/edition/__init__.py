"""The students' edition: its files, its folder with the git repository, and its zip."""
