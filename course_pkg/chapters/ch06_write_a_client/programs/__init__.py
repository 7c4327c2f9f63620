"""The nodes that only chapter 06 runs; CMakeLists.txt makes an executable of each module."""
