"""The nodes that several chapters run; CMakeLists.txt creates an executable for each module."""
