"""The nodes that only chapter 08 runs; CMakeLists.txt makes an executable of each module."""
