"""The nodes that only chapter 15 runs; CMakeLists.txt turns each module into an executable."""
