"""Example answers of chapter 07; tests/checking/answers/example_answers.py explains the format."""

# %% 07.1 right: completes the generated file
solution()

# %% 07.1 right: uses format 3 with depend
"""%%writefile src/my_geometry/package.xml
<?xml version="1.0"?>
<package format="3">
  <name>my_geometry</name>
  <version>1.0.0</version>
  <description>Area and volume of a box.</description>
  <maintainer email="me@robots.example">Me</maintainer>
  <license>BSD</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <depend>rospy</depend>
  <depend>std_msgs</depend>
</package>
"""

# %% 07.1 right: uses markup in the description, and a maintainer in a comment
replace("<description>", "<description><b>Boxes:</b> ")
replace("  <maintainer", '  <!-- <maintainer email="you@todo.todo">you</maintainer> -->\n  <maintainer')
# %% 07.1 wrong: omits message_runtime | hint: The name of a package
replace("\n  <exec_depend>message_runtime</exec_depend>", "")
# %% 07.1 wrong: omits rospy | hint: , but package.xml has no tag
based_on("uses format 3 with depend")
replace("\n  <depend>rospy</depend>", "")
# %% 07.1 wrong: uses the tag of format 1 | hint: in place of run_depend
replace("exec_depend>message_runtime</exec_depend", "run_depend>message_runtime</run_depend")
replace("exec_depend>rospy</exec_depend", "run_depend>rospy</run_depend")
replace("exec_depend>std_msgs</exec_depend", "run_depend>std_msgs</run_depend")
# %% 07.1 wrong: names message_runtime only in a build_depend | hint: . Also add a line
replace("<exec_depend>message_runtime</exec_depend>", "<build_depend>message_runtime</build_depend>")
# %% 07.1 wrong: writes a condition that is false in ROS 1 | hint: has the attribute `condition`
based_on("uses format 3 with depend")
replace("<depend>rospy", '<depend condition="$ROS_VERSION == 2">rospy')
# %% 07.1 wrong: leaves the generated description | hint: Describe in one sentence what the
replace("A service that measures boxes.", "The my_geometry package")
# %% 07.1 wrong: does not name a licence | hint: Write the name of a licence,
replace("MIT", "TODO")
# %% 07.1 wrong: leaves the generated description with a character reference | hint: Describe in one sentence what the
replace("A service that measures boxes.", "The my_geometry&#32;package")
# %% 07.1 wrong: writes TODO with a character reference | hint: Write the name of a licence,
replace("MIT", "TOD&#79;")
# %% 07.1 wrong: leaves the generated email address | hint: still ends with @todo.todo
replace("you@example.com", "you@todo.todo")
# %% 07.1 wrong: uses capital letters in the name | hint: lower-case letters
replace("<name>my_geometry", "<name>My Geometry")
# %% 07.1 wrong: does not close a tag | hint: Close every
replace("MIT</license>", "MIT")

# %% 07.2 right: follows the lab sheet
solution()
# %% 07.2 right: adds comments and blank lines
replace("float32 length\nfloat32 width", "# The sides of a box, in metres.\nfloat32 length\nfloat32 width   # along y\n")
replace("float32 area", "float32   area    # of the floor, in square metres\n")
# %% 07.2 wrong: writes a tab | hint: There is a tab between
replace("float32 width", "float32\twidth")
# %% 07.2 wrong: omits the dashes | hint: three dashes
replace("---\n", "")
# %% 07.2 wrong: uses the type float of C++ | hint: float32
replace("float32 length", "float length")
# %% 07.2 wrong: misspells a field | hint: with the name in the exercise,
replace("length", "lenght")
# %% 07.2 wrong: omits the volume | hint: has no field … volume
replace("\nfloat32 volume", "")
# %% 07.2 wrong: writes the area in the request | hint: is on the wrong side of
replace("---\nfloat32 area", "float32 area\n---")
# %% 07.2 wrong: adds a field | hint: contains the field
replace("float32 volume", "float32 volume\nstring unit")
# %% 07.2 wrong: uses float64 | hint: Copy the type from the exercise
replace("float32", "float64", times=5)
# %% 07.2 wrong: writes the width first | hint: The order of the fields is
replace("float32 length\nfloat32 width", "float32 width\nfloat32 length")
# %% 07.2 wrong: adds a constant | hint: The MD5 sum is wrong
replace("float32 length", "uint8 SIDES=3\nfloat32 length")

# %% 07.3 right: uses the order of the chapter
solution()

# %% 07.3 right: writes all names without variables
"""%%writefile src/my_geometry/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(my_geometry)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs rospy)
add_service_files(
  FILES
  geometry.srv
)
generate_messages(
  DEPENDENCIES
  std_msgs
)
add_custom_target(my_geometry_programs ALL)
add_dependencies(my_geometry_programs my_geometry_generate_messages)
catkin_package(
  CATKIN_DEPENDS std_msgs rospy message_runtime
)
"""

# %% 07.3 wrong: names only message_runtime in catkin_package | hint: Your catkin_package does not name … rospy and std_msgs
replace("message_runtime rospy std_msgs", "message_runtime")
# %% 07.3 wrong: omits add_service_files | hint: , so the build generates no
replace("\nadd_service_files(FILES geometry.srv)", "")
# %% 07.3 wrong: turns generate_messages into a comment | hint: The command generate_messages is missing, so the build generates no
replace("generate_messages(DEP", "# generate_messages(DEP")
replace("\nadd_custom_target(${PROJECT_NAME}_programs ALL)", "")
replace("\nadd_dep", "\n# add_dep")
# %% 07.3 wrong: writes generate_messages in a condition that is false | hint: Look for an if() with
replace("generate_messages(DEPENDENCIES std_msgs)", "if(NOT TRUE)\ngenerate_messages()\nendif()")
# %% 07.3 wrong: omits message_generation | hint: COMPONENTS message_generation
replace("  message_generation\n", "")
# %% 07.3 wrong: names another file | hint: Do not write the folder srv
replace("geometry.srv", "Geometry.srv")
# %% 07.3 wrong: calls catkin_package first | hint: Move generate_messages above
replace("\ncatkin_package(CATKIN_DEPENDS message_runtime rospy std_msgs)", "")
replace("\nadd_service_files", "\ncatkin_package(CATKIN_DEPENDS message_runtime rospy std_msgs)\nadd_service_files")
# %% 07.3 wrong: omits the target | hint: The target does not exist.
replace("\nadd_custom_target(${PROJECT_NAME}_programs ALL)", "")
replace("\nadd_dep", "\n# add_dep")
# %% 07.3 wrong: uses another name for the target | hint: The name of the target is
replace("${PROJECT_NAME}_programs", "programs", times=2)
# %% 07.3 wrong: omits add_dependencies | hint: The target does not depend
replace("\nadd_dep", "\n# add_dep")
# %% 07.3 wrong: writes only one pair of braces | hint: Write both pairs of ${ }
replace("${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS}", "${PROJECT_NAME_EXPORTED_TARGETS}")
# %% 07.3 wrong: writes the name of the variable instead of its value | hint: Write ${ } around the whole name
replace("${${PROJECT_NAME}_EXPORTED_TARGETS}", "${PROJECT_NAME}_EXPORTED_TARGETS")
# %% 07.3 wrong: names only the targets of other packages | hint: Your add_dependencies contains only targets of other
replace("${${PROJECT_NAME}_EXPORTED_TARGETS} ", "")
# %% 07.3 wrong: writes add_dependencies above generate_messages | hint: this package's targets is still empty
replace("\nadd_custom_target(${PROJECT_NAME}_programs ALL)", "")
replace("\nadd_dependencies(${PROJECT_NAME}_programs ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})", "")
replace("\nadd_service_files", """
add_custom_target(${PROJECT_NAME}_programs ALL)
add_dependencies(${PROJECT_NAME}_programs ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
add_service_files""")
# %% 07.3 wrong: names message_generation in catkin_package | hint: write message_runtime instead of message_generation
replace("CATKIN_DEPENDS message_runtime", "CATKIN_DEPENDS message_generation")
# %% 07.3 wrong: names no package in catkin_package | hint: Your catkin_package does not name
replace("CATKIN_DEPENDS message_runtime rospy std_msgs", "")
# %% 07.3 wrong: writes message_runtime only in a generated comment | hint: Your catkin_package does not name
replace("CATKIN_DEPENDS message_runtime rospy std_msgs)", """CATKIN_DEPENDS rospy std_msgs)
file(APPEND "${CATKIN_DEVEL_PREFIX}/share/my_geometry/cmake/my_geometryConfig.cmake" "# message_runtime")""")
# %% 07.3 wrong: omits catkin_package | hint: Without catkin_package
replace("\ncatkin_package(CATKIN_DEPENDS message_runtime rospy std_msgs)", "")

# %% 07.4 right: follows the lab sheet
solution()
# %% 07.4 right: uses a class, a relative name and a main function
replace("env python3", 'python3\n"""Measures boxes."""')
replace("from my_geometry.srv import geometry, geometryResponse", "import my_geometry.srv as srv")
replace("def handle_geometry … request.height)", """class Measurer:
    def __init__(self):
        self.calls = 0
        self.service = rospy.Service("getGeometry", srv.geometry, self.measure)

    def measure(self, req):
        self.calls += 1
        floor = req.length * req.width
        return floor, floor * req.height""")
replace('if __name__ == "__main__"', "def main()")
replace('rospy.Service("/getGeometry", geometry, handle_geometry)', 'Measurer()\n    rospy.loginfo("ready")')
replace("spin()", "spin()\n\n\nif __name__ == '__main__':\n    main()")
# %% 07.4 right: uses a dataclass in the script
replace("import rospy\n", """import dataclasses

import rospy


@dataclasses.dataclass
class Size:
    area: float = 0.0
    volume: float = 0.0


""")
# %% 07.4 wrong: omits the shebang | hint: Without a shebang, Linux runs the
replace("#!/usr/bin/env python3\n", "")
# %% 07.4 wrong: writes the shebang in line 2 | hint: The shebang is in the
replace("#!/usr", "\n#!/usr")
# %% 07.4 wrong: uses python2 in the shebang | hint: The shebang names the wrong
replace("python3", "python2")
# %% 07.4 wrong: uses line endings of Windows | hint: The file has Windows line … The file has Windows line
replace("python3", "python3\r")
# %% 07.4 wrong: uses a Windows program in the shebang | hint: The first line of the script
replace("/usr/bin/env python3", "C:/Python/python3.exe")

# %% 07.4 wrong: does not make the script executable | hint: chmod +x
from pathlib import Path

script = Path("src/my_geometry/scripts/server.py")
script.write_text("#!/usr/bin/env python3\nimport rospy\n")
script.chmod(0o644)

# %% 07.4 wrong: omits the main guard | hint: An import of the script starts
replace("if __name__ … rospy.spin()", """rospy.init_node("SERVER_NODE")
rospy.Service("/getGeometry", geometry, handle_geometry)
rospy.spin()""")
# %% 07.4 wrong: tests the name of the program in place of __name__ | hint: An import of the script starts
replace("import rospy\n", "import sys\n\nimport rospy\n")
replace('__name__ == "__main__"', 'sys.argv[0].endswith(".py")')
# %% 07.4 wrong: does not call spin | hint: The program ended, so its service
replace("\n    rospy.spin()", "")
# %% 07.4 wrong: imports the type from the course's package | hint: Import the type from your own
replace("my_geometry.srv", "my_geometry_services.srv")
# %% 07.4 wrong: misspells the type | hint: Compare Geometry with the name of the .srv file
replace("import geometry, geometryResponse", "import Geometry, geometryResponse")
replace('"/getGeometry", geometry', '"/getGeometry", Geometry')
# %% 07.4 wrong: uses another service name | hint: The program serves … Change the name of the service
replace('"/getGeometry"', '"/get_geometry"')
# %% 07.4 wrong: does not create the service | hint: The program runs, but it
replace('\n    rospy.Service("/getGeometry", geometry, handle_geometry)', "")
# %% 07.4 wrong: does not call init_node | hint: A service needs a node
replace('\n    rospy.init_node("SERVER_NODE")', "")
# %% 07.4 wrong: uses another node name | hint: without anonymous=True … SERVER_NODE
replace("SERVER_NODE", "server")
# %% 07.4 wrong: uses an anonymous node | hint: without anonymous=True
replace('"SERVER_NODE"', '"SERVER_NODE", anonymous=True')
# %% 07.4 wrong: passes the response class to rospy.Service | hint: Pass the class of the service type
replace('"/getGeometry", geometry,', '"/getGeometry", geometryResponse,')
# %% 07.4 wrong: misspells a variable | hint: The error occurred in line … of server.py
replace("geometry, handle_geometry)", "geometry, handle_box)")
# %% 07.4 wrong: ends with an error message | hint: An error has ended the program.
replace("    rospy.spin()", '    raise SystemExit("Error: no robot")')
# %% 07.4 wrong: imports a program of the course | hint: Your script starts or imports a program
replace("    rospy.spin()", "    import course_pkg.nodes.server")
# %% 07.4 wrong: ends some time after the sixth call | hint: The service ended some time after
replace("import rospy\n", "import threading\n\nimport rospy\n")
replace("def handle_geometry(request):", """calls = []


def handle_geometry(request):
    calls.append(request)
    if len(calls) == 6:
        threading.Timer(0.5, rospy.signal_shutdown, args=["enough calls"]).start()""")
# %% 07.4 wrong: returns width plus length as the area | hint: Your area is the sum
replace("request.width * request.length", "request.width + request.length")
# %% 07.4 wrong: returns the perimeter as the area | hint: Your area is the perimeter.
replace("request.width * request.length", "2 * (request.width + request.length)")
# %% 07.4 wrong: returns width times height as the area | hint: Your area is width times
replace("request.width * request.length", "request.width * request.height")
replace("area * request.height", "area * request.length")
# %% 07.4 wrong: rounds the area to two digits | hint: Do not round the area
replace("area=area, ", "area=round(area, 2), ")
# %% 07.4 wrong: rounds the volume to one digit | hint: Do not round the volume
replace("area * request.height", "round(area * request.height, 1)")
# %% 07.4 wrong: returns an empty response | hint: The area is 0.0, because
replace("geometryResponse(area=area, volume=area * request.height)", "geometryResponse()")
# %% 07.4 wrong: squares the width | hint: Compute the area from request.width and request.length
replace("request.width * request.length", "request.width * request.width")
# %% 07.4 wrong: omits the volume | hint: The volume is 0.0, because
replace(", volume=area * request.height", "")
# %% 07.4 wrong: returns the right area only for usual sizes | hint: The area is 0.0, because
replace("area = request.width * request.length", "area = request.width * request.length * (0.4 < request.width < 9.1)")
# %% 07.4 wrong: returns the volume of a cube | hint: Compute the volume from the area
replace("area * request.height", "area ** 1.5")
# %% 07.4 wrong: returns None from the handler | hint: without a return
replace("    return geometryResponse", "    geometryResponse")
# %% 07.4 wrong: exits when the script is imported | hint: An import of the script starts the node
replace("import rospy\n", "import os\n\nimport rospy\n\nif __name__ != '__main__':\n    os._exit(0)\n")

# %% 07.5 right: uses the solution from the chapter
solution()
# %% 07.5 right: writes a node with separate steps
replace("python3", 'python3\n"""Asks for the area and the volume of a box."""')
replace("import sys\n", "import sys")
replace('\n\nUSAGE = "usage: rosrun my_geometry client.py LENGTH WIDTH HEIGHT"', ", geometryRequest")
replace("def main(arguments … return 0", 'def usage():\n    print("usage: client.py LENGTH WIDTH HEIGHT")\n    sys.exit(2)')
replace('if __name__ == "__main__":\n    sys.exit(main(rospy.myargv(sys.argv)[1:]))', """if __name__ == '__main__':
    argv = rospy.myargv()
    if len(argv) != 4:
        usage()
    request = geometryRequest()
    try:
        request.length = float(argv[1])
        request.width = float(argv[2])
        request.height = float(argv[3])
    except ValueError:
        usage()
    rospy.init_node("client", anonymous=True)
    try:
        rospy.wait_for_service("getGeometry", 3.0)
        measure = rospy.ServiceProxy("getGeometry", geometry)
        answer = measure(request)
    except rospy.ROSException as error:
        rospy.logerr("no server: %s", error)
        sys.exit(1)
    except rospy.ServiceException as error:
        rospy.logerr("the call failed: %s", error)
        sys.exit(1)
    print("area: %.2f" % answer.area)
    print("volume: %.2f" % answer.volume)""")
# %% 07.5 wrong: does not remove ROS's arguments from sys.argv | hint: ROS uses the arguments that contain :=.
replace("rospy.myargv(sys.argv)[1:]", "sys.argv[1:]")
# %% 07.5 wrong: removes only the arguments that begin with an underscore | hint: ROS uses the arguments that contain :=.
replace("rospy.myargv(sys.argv)[1:]", '[text for text in sys.argv[1:] if not text.startswith("_")]')
# %% 07.5 wrong: accepts only digits and a point | hint: -1.2, 52e-1 and 9 are numbers
replace("    try:\n        length", '    if not all(text.replace(".", "", 1).isdigit() for text in arguments):\n        print(USAGE)\n        return 2\n    try:\n        length')
# %% 07.5 wrong: sends the height first | hint: The request contains the numbers
replace("(length, width, height)\n", "(height, width, length)\n")
# %% 07.5 wrong: converts the arguments to int | hint: Convert the three arguments to float,
replace("geometry)(length, width, height)", "geometry)(int(length), int(width), int(height))")
# %% 07.5 wrong: calls the service twice | hint: The client called the service more than once.
replace("    print(f\"area:", "    rospy.ServiceProxy(\"/getGeometry\", geometry)(length, width, height)\n    print(f\"area:")
# %% 07.5 wrong: prints all digits | hint: Print one line with the text
replace("response.area:.2f", "response.area")
# %% 07.5 wrong: uses round instead of a format | hint: Print one line with the text
replace("response.area:.2f", "round(response.area, 2)")
# %% 07.5 wrong: waits for another service | hint: The client waits, but it sends
replace('wait_for_service("/getGeometry", timeout=5)', 'wait_for_service("/get_geometry")')
# %% 07.5 wrong: makes no call | hint: The client ended, but it sent
replace('        response = rospy.ServiceProxy("/getGeometry", geometry)(length, width, height)\n', "")
replace("    print(f\"area: {response.area:.2f}\")\n    print(f\"volume: {response.volume:.2f}\")\n", "")
# %% 07.5 wrong: does not convert the arguments | hint: The error occurred in line
replace("map(float, arguments)", "arguments")
replace(" as error:", " as error:")
# %% 07.5 wrong: calculates the area without the response | hint: The client prints a number that
replace("response.area:.2f", "length * width:.2f")
# %% 07.5 wrong: prints only the values of the response | hint: Print one line with the text
replace('    print(f"area: {response.area:.2f}")\n    print(f"volume: {response.volume:.2f}")', "    print(response.area, response.volume)")
# %% 07.5 wrong: exits with status 3 | hint: The exit status has to be 0
replace("    return 0\n", "    return 3\n")
# %% 07.5 wrong: does not exit after the call | hint: The client does not end. Remove
replace("    return 0\n", "    while True:\n        pass\n")
# %% 07.5 wrong: prints the usage, but exits with status 0 | hint: The exit status has to be 2
replace("        return 2", "        return 0")
# %% 07.5 wrong: does not catch the error of a text argument | hint: float() raises ValueError for a text
based_on("writes a node with separate steps")
replace("except ValueError:\n        usage()", "except TypeError:\n        usage()")
# %% 07.5 wrong: accepts four arguments | hint: The client accepted four arguments.
replace("map(float, arguments)\n", "map(float, arguments[:3])\n")
# %% 07.5 wrong: prints no usage | hint: Print a line that begins with
replace("print(USAGE, file=sys.stderr)", "pass")
# %% 07.5 wrong: waits for the server before it reads the arguments | hint: The client waited for the service before
replace("    try:\n        length, width, height = map(float, arguments)\n    except ValueError:\n        print(USAGE, file=sys.stderr)\n        return 2\n", "")
replace('"/getGeometry", timeout=5)', '"/getGeometry", timeout=5)\n        length, width, height = map(float, arguments)')
replace("        return 1\n", "        return 1\n    except ValueError:\n        print(USAGE, file=sys.stderr)\n        return 2\n")
# %% 07.5 wrong: prints another text before the usage | hint: Print a line that begins with
replace('"usage:', '"Wrong arguments, usage:')
# %% 07.5 wrong: calls the service with zeros if the arguments are wrong | hint: The client sent a request
replace("        return 2", '        rospy.ServiceProxy("/getGeometry", geometry)(0, 0, 0)\n        return 2')
# %% 07.5 wrong: prints a traceback after a refusal | hint: The client printed a traceback.
replace("(rospy.ServiceException, rospy.ROSException)", "rospy.ROSException")
# %% 07.5 wrong: omits the message of a refusal | hint: Print the message of the exception
replace("print(error, file=sys.stderr)", 'print("failed")')
# %% 07.5 wrong: waits without a limit | hint: The client waits for the
replace(", timeout=5", "")
# %% 07.5 wrong: waits for the service for 13 s | hint: The client waits longer than 5 s
replace("timeout=5", "timeout=13")
# %% 07.5 wrong: does not wait for the service | hint: The client did not wait
replace('        rospy.wait_for_service("/getGeometry", timeout=5)\n', "")
# %% 07.5 wrong: does not catch the timeout | hint: wait_for_service raises rospy.ROSException when the timeout is over
replace("(rospy.ServiceException, rospy.ROSException)", "rospy.ServiceException")
# %% 07.5 wrong: exits with status 0 if there is no server | hint: The exit status has to be 1
based_on("writes a node with separate steps")
replace('rospy.logerr("no server: %s", error)\n        sys.exit(1)', 'rospy.logerr("no server: %s", error)\n        sys.exit(0)')

# %% 07.6 right: uses catkin_install_python
solution()

# %% 07.6 right: uses two rules, one of them from CMake
"""%%writefile src/my_geometry/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(my_geometry)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs rospy)
add_service_files(FILES geometry.srv)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS message_runtime)
catkin_install_python(PROGRAMS scripts/server.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(PROGRAMS scripts/client.py DESTINATION lib/${PROJECT_NAME})
"""

# %% 07.6 wrong: writes no install rule | hint: The install rule is missing.
replace("\n\ncatkin_install_python( … BIN_DESTINATION}\n)", "")
# %% 07.6 wrong: copies the files with CMake, without a rule | hint: The install rule is missing.
replace("catkin_install_python( … BIN_DESTINATION}\n)", "file(COPY scripts/server.py scripts/client.py DESTINATION ${CMAKE_BINARY_DIR}/../install/lib/my_geometry)")
# %% 07.6 wrong: omits the client | hint: . List both scripts after PROGRAMS.
replace(" scripts/client.py", "")
# %% 07.6 wrong: writes a wrong destination | hint: rosrun does not search the
replace("${CATKIN_PACKAGE_BIN_DESTINATION}", "bin")
# %% 07.6 wrong: installs the client as a file, not as a program | hint: removes the permission to execute a file
based_on("uses two rules, one of them from CMake")
replace("install(PROGRAMS scripts/client.py", "install(FILES scripts/client.py")
# %% 07.6 wrong: installs the folder without its permissions | hint: removes the permission to execute a file
based_on("uses two rules, one of them from CMake")
replace("catkin_install_python … DESTINATION lib", "install(DIRECTORY scripts/ DESTINATION lib")
# %% 07.6 wrong: installs the scripts in the folder share | hint: The script is installed in the folder share
replace("${CATKIN_PACKAGE_BIN_DESTINATION}", "${CATKIN_PACKAGE_SHARE_DESTINATION}/scripts")
# %% 07.6 wrong: installs a client that its owner cannot execute | hint: do not contain OWNER_EXECUTE
based_on("uses two rules, one of them from CMake")
replace("${PROJECT_NAME})", "${PROJECT_NAME} PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ GROUP_EXECUTE)")
# %% 07.6 wrong: installs links to the scripts in src | hint: rosrun does not find the installed script
replace("catkin_install_python( … BIN_DESTINATION}\n)", """install(CODE "
  file(MAKE_DIRECTORY \\${CMAKE_INSTALL_PREFIX}/lib/my_geometry)
  execute_process(COMMAND ln -sf
    ${CMAKE_CURRENT_SOURCE_DIR}/scripts/server.py
    ${CMAKE_CURRENT_SOURCE_DIR}/scripts/client.py
    \\${CMAKE_INSTALL_PREFIX}/lib/my_geometry
  )
")""")
# %% 07.6 right: installs the whole folder with its permissions
based_on("uses two rules, one of them from CMake")
replace("catkin_install_python … DESTINATION lib", "install(DIRECTORY scripts/ USE_SOURCE_PERMISSIONS DESTINATION lib")
# %% 07.6 wrong: names a path that does not exist | hint: Compare each path in the rule
based_on("uses two rules, one of them from CMake")
replace("install(PROGRAMS scripts/client.py", "install(PROGRAMS client.py")
# %% 07.6 wrong: installs an empty client | hint: The installed file differs
based_on("uses two rules, one of them from CMake")
replace("install(PROGRAMS scripts/client.py", 'file(WRITE ${CMAKE_BINARY_DIR}/client.py "#!/bin/true")\ninstall(PROGRAMS ${CMAKE_BINARY_DIR}/client.py')

# %% 07.7 right: writes short instructions
"""%%writefile src/my_geometry/README.md
# my_geometry

A service that returns the area and the volume of a box.

```bash
catkin_make
source devel/setup.bash
rosrun my_geometry server.py
```

In a second terminal:

```bash
source devel/setup.bash
rosservice call /getGeometry 1.2 5.2 8.9
rosrun my_geometry client.py 1.2 5.2 8.9
```
"""

# %% 07.7 right: writes prompts, and several code blocks
"""%%writefile src/my_geometry/README.md

# The geometry server

## Build

~~~
$ cd ~/catkin_ws && catkin_make
~~~

## Run

~~~sh
$ . devel/setup.bash
$ roscore &
$ rosrun my_geometry server.py __name:=box_server
$ rosservice call getGeometry 1 2 3   # area 2, volume 6
~~~
"""

# %% 07.7 right: uses a numbered list, and names the fields in the call
"""%%writefile src/my_geometry/README.md
# Geometry

1. Build it:

   ```sh
   cd workspace && catkin_make
   ```

2. In each terminal: source it, and start the server:

   ```sh
   . devel/setup.bash
   rosrun my_geometry server.py &
   rosservice call --wait getGeometry "{length: 1.2, width: 5.2, height: 8.9}"
   ```
"""
# %% 07.7 wrong: omits the title | hint: The title is missing. Write
replace("# my_geometry\n", "my_geometry\n")
# %% 07.7 wrong: writes the title without a space | hint: A space is missing after the character #
replace("# my_geometry\n", "#my_geometry\n")
# %% 07.7 wrong: omits the code block | hint: Write a line ``` above
replace("```bash\n", "", times=2)
replace("```\n", "", times=2)
# %% 07.7 wrong: writes everything in an HTML comment | hint: Write a line ``` above
replace("# my_geometry\n", "# my_geometry\n<!--")
replace("8.9\n```", "8.9\n```\n-->")
# %% 07.7 wrong: prints the build command with echo | hint: The command that builds the package
replace("catkin_make", "echo catkin_make")
# %% 07.7 wrong: writes only comments in the code block | hint: In the code block, each line begins
replace("catkin_make\nsource", "# catkin_make\n# source")
replace("rosrun my_geometry server.py", "# rosrun my_geometry server.py")
replace("source devel/setup.bash\nrosservice", "# source devel/setup.bash\n# rosservice")
replace("rosrun my_geometry client.py", "# rosrun my_geometry client.py")
# %% 07.7 wrong: deletes the build instead of building | hint: The command that builds the package
replace("catkin_make", "catkin_make clean")
# %% 07.7 wrong: uses names of fields that do not exist | hint: has wrong names of fields
replace("/getGeometry 1.2 5.2 8.9", '/getGeometry "{a: 1.2, b: 5.2, c: 8.9}"')
# %% 07.7 wrong: omits the build | hint: The command that builds the package
replace("catkin_make\n", "")
# %% 07.7 wrong: omits the command source | hint: The command `source devel/setup.bash` is missing.
replace("source devel/setup.bash\n", "", times=2)
# %% 07.7 wrong: omits the package in the rosrun command | hint: The command that starts the server
replace("rosrun my_geometry server.py", "rosrun server.py")
# %% 07.7 wrong: calls the service with only two sides | hint: A part of the command that calls
replace("/getGeometry 1.2 5.2 8.9", "/getGeometry 1.2 5.2")
# %% 07.7 wrong: omits the call | hint: The call of the service is missing.
replace("rosservice call /getGeometry 1.2 5.2 8.9\nrosrun my_geometry client.py 1.2 5.2 8.9\n", "")
# %% 07.7 wrong: writes the call in a sentence | hint: is in the text, not in a code block
replace("source devel/setup.bash\nrosservice call /getGeometry 1.2 5.2 8.9\nrosrun my_geometry client.py 1.2 5.2 8.9\n```", "source devel/setup.bash\n```\n\nThen call the service: `rosservice call /getGeometry 1.2 5.2 8.9`.")
# %% 07.7 right: uses the folder install, and calls with the client
replace("catkin_make", "catkin_make install")
replace("source devel/setup.bash", "source install/setup.bash", times=2)
replace("rosservice call /getGeometry 1.2 5.2 8.9\n", "")
# %% 07.7 wrong: sources the workspace before the build | hint: The order of the commands
replace("catkin_make\nsource devel/setup.bash\n", "source devel/setup.bash\ncatkin_make\n")

# %% 07.8 right: follows the exercise
solution()
# %% 07.8 right: adds comments
replace("int32 number\n---\nstring state", "# 0 or 1; anything else is refused.\nint32  number\n---\nstring state  # OFF or ON")
# %% 07.8 wrong: uses a bool | hint: has the type bool. Copy the type
replace("int32", "bool")
# %% 07.8 wrong: writes both fields in the request | hint: state is on the wrong side
replace("---\nstring state", "string state\n---")
# %% 07.8 wrong: uses another field name | hint: has no field … number
replace("number", "value")
# %% 07.8 wrong: adds two constants | hint: The MD5 sum is wrong
replace("int32 number", "int32 OFF=0\nint32 ON=1\nint32 number")
# %% 07.8 wrong: uses the type String of Java | hint: string
replace("string state", "String state")

# %% 07.9 right: uses a table of states
solution()
# %% 07.9 right: uses conditions and a main function
replace('\n\nSTATES = {0: "OFF", 1: "ON"}', ", ServiceExampleResponse")
replace("def name_state … request.number]", """def handle(req):
    response = ServiceExampleResponse()
    if req.number == 0:
        response.state = "OFF"
    elif req.number == 1:
        response.state = "ON"
    else:
        rospy.logwarn("refused")
        raise rospy.ServiceException("the number is %d, and only 0 and 1 are allowed" % req.number)
    return response


def main():
    rospy.init_node("ON_OFF_SERVER")
    service = rospy.Service("onOff", ServiceExample, handle)
    rospy.spin()""")
replace('rospy.init_node("ON_OFF_SERVER")\n    rospy.Service("/onOff", ServiceExample, name_state)\n    rospy.spin()', "main()")
# %% 07.9 wrong: refuses 0 | hint: The server refused 0 or
replace("if request.number not in STATES", "if not request.number in (1, 2)")
# %% 07.9 wrong: returns an empty state | hint: The state is an empty
based_on("uses conditions and a main function")
replace('response.state = "OFF"', "pass")
replace('response.state = "ON"', "pass")
# %% 07.9 wrong: uses small letters | hint: The state contains small letters
replace('{0: "OFF", 1: "ON"}', '{0: "off", 1: "on"}')
# %% 07.9 wrong: exchanges the states | hint: The two states are exchanged
replace('{0: "OFF", 1: "ON"}', '{0: "ON", 1: "OFF"}')
# %% 07.9 wrong: returns other states | hint: This state is neither
replace('{0: "OFF", 1: "ON"}', '{0: "closed", 1: "open"}')
# %% 07.9 wrong: returns None for other numbers | hint: The handler returned no response. Raise
based_on("uses conditions and a main function")
replace("""rospy.logwarn("refused")
        raise rospy.ServiceException("the number is %d, and only 0 and 1 are allowed" % req.number)""", "return None")
# %% 07.9 wrong: omits the number in the error message | hint: The message of the exception
replace('f"{request.number} is neither 0 nor 1"', '"neither 0 nor 1"')
# %% 07.9 wrong: looks only at the lowest 16 bits | hint: The server accepted a number
replace("    if request.number not in", "    number = request.number & 0xFFFF\n    if number not in")
replace("STATES[request.number]", "STATES[number]")
# %% 07.9 wrong: raises a KeyError | hint: The exception has the wrong
replace('\n    if request.number not in STATES:\n        raise rospy.ServiceException(f"{request.number} is neither 0 nor 1")', "")
# %% 07.9 wrong: becomes a program of the course | hint: Your script starts or imports a program
"""%%writefile src/service_example/scripts/on_off_server.py
#!/usr/bin/env python3
import os

if __name__ == "__main__":
    os.execvp("rosrun", ["rosrun", "course_pkg", "on_off_server", "__name:=ON_OFF_SERVER", "on_off:=/onOff"])
"""
# %% 07.9 wrong: shuts down some time after the third call | hint: The service ended some time after
replace("import rospy\n", "import threading\n\nimport rospy\n")
replace("    if request.number not in STATES", """    CALLS.append(request)
    if len(CALLS) == 3:
        threading.Timer(0.5, rospy.signal_shutdown, args=["enough calls"]).start()
    if request.number not in STATES""")
replace("STATES = {", "CALLS = []\nSTATES = {")
# %% 07.9 wrong: accepts every number | hint: The server accepted a number
replace("if request … request.number]", 'return "ON" if request.number else "OFF"')

# %% 07.10 right: uses the solution from the chapter
solution()
# %% 07.10 right: writes a node with functions
replace("\nimport rospy\nfrom service_example.srv import ServiceExample", """import rospy
from service_example.srv import ServiceExample, ServiceExampleRequest


def call(proxy):
    request = ServiceExampleRequest(number=random.choice([0, 1]))
    response = proxy(request)
    print("%d: %s" % (request.number, response.state))


def main():
    arguments = rospy.myargv(sys.argv)
    if len(arguments) != 2:
        sys.exit("usage: on_off_client.py COUNT")
    rospy.init_node("on_off_client", anonymous=True)
    rospy.wait_for_service("onOff", timeout=5)
    proxy = rospy.ServiceProxy("onOff", ServiceExample)
    for _ in range(int(arguments[1])):
        call(proxy)
""")
replace('rospy.wait_for_service("/onOff", timeout … ).state}")', "main()")
# %% 07.10 wrong: calls the service only once | hint: The client called the service only once.
replace("    for _ in range(int(sys.argv[1])):", "    for _ in range(1):")
# %% 07.10 wrong: always makes ten calls | hint: The number of calls is
replace("range(int(sys.argv[1]))", "range(10)")
# %% 07.10 wrong: calls the service only for a new number | hint: even if the client has sent the same number
replace("name_state(number).state", "states.setdefault(number, name_state(number).state) if number not in states else states[number]")
replace("    for _ in", "    states = {}\n    for _ in")
# %% 07.10 wrong: prints states without a call | hint: The client ended, but it did not call /onOff
replace("name_state(number).state", '"ON" if number else "OFF"')
# %% 07.10 wrong: makes one call too many | hint: The client made one call too
replace("range(int(sys.argv[1]))", "range(int(sys.argv[1]) + 1)")
# %% 07.10 wrong: always sends the same number | hint: The numbers are not random.
replace("random.randint(0, 1)", "1")
# %% 07.10 wrong: sends a repeated pattern of numbers | hint: The numbers are not random.
replace("for _ in range", "for count in range")
replace("random.randint(0, 1)", "int(count % 4 != 2)")
# %% 07.10 wrong: prints only the state | hint: The output is wrong. For
replace('f"{number}: {name_state(number).state}"', "name_state(number).state")
# %% 07.10 wrong: prints the expected state instead of the response | hint: the check's server returned other states
replace("print(f\"{number}: {name_state(number).state}\")", "name_state(number)\n        print(f\"{number}: {'ON' if number else 'OFF'}\")")
# %% 07.10 wrong: prints a space before the colon | hint: The client prints a space before the colon
replace('f"{number}: {name_state(number).state}"', 'number, ":", name_state(number).state')
# %% 07.10 wrong: calls another service | hint: The client does not end. Check
replace('("/onOff", timeout=5)', '("/on_off")')
# %% 07.10 wrong: exits with an error status | hint: The exit status is not
replace('{name_state(number).state}")', '{name_state(number).state}")\n    sys.exit(4)')
# %% 07.10 wrong: does not convert the argument | hint: on_off_client.py
replace("int(sys.argv[1])", "sys.argv[1]")
