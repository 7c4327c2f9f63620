"""The nodes that only chapter 16 uses; CMakeLists.txt makes an executable from each module."""
