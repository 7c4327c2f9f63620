"""The nodes that only chapter 11 runs; CMakeLists.txt turns each module into an executable."""
