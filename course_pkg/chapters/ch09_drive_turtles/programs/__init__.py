"""The nodes that only chapter 09 uses; CMakeLists.txt makes an executable from each module."""
