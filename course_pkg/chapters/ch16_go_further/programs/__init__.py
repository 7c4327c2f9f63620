"""The nodes that only chapter 16 runs; CMakeLists.txt turns each module into an executable."""
