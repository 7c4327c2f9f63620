"""The nodes that only chapter 09 runs; CMakeLists.txt turns each module into an executable."""
