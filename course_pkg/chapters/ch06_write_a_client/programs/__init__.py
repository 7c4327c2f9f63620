"""The nodes that only chapter 06 uses; CMakeLists.txt makes an executable from each module."""
