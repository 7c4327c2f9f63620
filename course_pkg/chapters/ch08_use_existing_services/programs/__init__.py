"""The nodes that only chapter 08 uses; CMakeLists.txt makes an executable from each module."""
