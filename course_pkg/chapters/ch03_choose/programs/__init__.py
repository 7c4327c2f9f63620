"""The nodes that only chapter 03 uses; CMakeLists.txt makes an executable from each module."""
