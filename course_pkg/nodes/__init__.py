"""The nodes that several chapters run; CMakeLists.txt makes an executable of each module."""
