"""The nodes that only chapter 15 uses; CMakeLists.txt makes an executable from each module."""
