"""The nodes that only chapter 03 runs; CMakeLists.txt makes an executable of each module."""
