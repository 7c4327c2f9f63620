"""The nodes that only chapter 11 uses; CMakeLists.txt makes an executable from each module."""
