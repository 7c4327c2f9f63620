"""The two packages of chapter 07.

If the student has not written a file, the check uses the course's version of this file.
"""

from __future__ import annotations

from course_pkg.checking.plain_values import ServiceClass
from course_pkg.checking.shared.catkin_package import Package
from course_pkg.types import compile_service

MANIFEST = """\
<?xml version="1.0"?>
<package format="2">
  <name>{name}</name>
  <version>0.1.0</version>
  <description>A package of the lab sheet.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>

  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <build_depend>rospy</build_depend>
  <build_depend>std_msgs</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <exec_depend>rospy</exec_depend>
  <exec_depend>std_msgs</exec_depend>
</package>
"""
LISTS = """\
cmake_minimum_required(VERSION 3.0.2)
project({name})

find_package(catkin REQUIRED COMPONENTS message_generation rospy std_msgs)

add_service_files(FILES {definition})
generate_messages(DEPENDENCIES std_msgs)

catkin_package(CATKIN_DEPENDS message_runtime rospy std_msgs)
"""
GEOMETRY = """\
float32 length
float32 width
float32 height
---
float32 area
float32 volume
"""
SERVICE_EXAMPLE = """\
int32 number
---
string state
"""
SERVER = """\
#!/usr/bin/env python3
import rospy
from my_geometry.srv import geometry, geometryResponse


def handle_geometry(request):
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)


if __name__ == "__main__":
    rospy.init_node("SERVER_NODE")
    rospy.Service("/getGeometry", geometry, handle_geometry)
    rospy.spin()
"""
CLIENT = """\
#!/usr/bin/env python3
import sys

import rospy
from my_geometry.srv import geometry

if __name__ == "__main__":
    rospy.wait_for_service("/getGeometry", timeout=5)
    response = rospy.ServiceProxy("/getGeometry", geometry)(*map(float, sys.argv[1:4]))
    print(f"area: {response.area:.2f}")
    print(f"volume: {response.volume:.2f}")
"""

MY_GEOMETRY = Package(
    "my_geometry",
    {
        "package.xml": MANIFEST.format(name="my_geometry"),
        "CMakeLists.txt": LISTS.format(name="my_geometry", definition="geometry.srv"),
        "srv/geometry.srv": GEOMETRY,
        "scripts/server.py": SERVER,
        "scripts/client.py": CLIENT,
    },
)
SERVICE_EXAMPLE_PACKAGE = Package(
    "service_example",
    {
        "package.xml": MANIFEST.format(name="service_example"),
        "CMakeLists.txt": LISTS.format(name="service_example", definition="ServiceExample.srv"),
        "srv/ServiceExample.srv": SERVICE_EXAMPLE,
    },
)


def geometry_class() -> ServiceClass:
    """Return the class of my_geometry/geometry."""
    return compile_service("my_geometry/geometry", GEOMETRY).cls


def service_example_class() -> ServiceClass:
    """Return the class of service_example/ServiceExample."""
    return compile_service("service_example/ServiceExample", SERVICE_EXAMPLE).cls
