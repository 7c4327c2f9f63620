"""Example answers of chapter 04; tests/checking/answers/example_answers.py explains the format."""

# %% 04.1 right: follows the description
"""%%writefile src/lamp_services/srv/Lamp.srv
# What the lamp is to do.
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2

uint8 mode
std_msgs/ColorRGBA colour
float32[] seconds
---
bool success
float32[3] rgb
float32 total
"""

# %% 04.1 right: writes constants between the fields, and comments on many lines
replace("# What the … uint8 BLINK=2", "uint8 mode   # one of the three:\nuint8 OFF = 0\nuint8  ON = 1    # steady\nuint8 BLINK =2")
replace("uint8 mode\nstd_msgs/ColorRGBA colour\nfloat32[] seconds", "std_msgs/ColorRGBA   colour\nfloat32[] seconds # of each blink")
replace("---", "---\n# all went well")
replace("[3] rgb", "[3] rgb\n")
# %% 04.1 wrong: writes blanks between the three dashes | hint: This is not a line of three dashes
replace("---\nbool success", "- - -\nbool success")
# %% 04.1 wrong: omits the line between request and response | hint: Add a line of three dashes
replace("---\nbool success", "bool success")
# %% 04.1 wrong: uses the type float of other languages | hint: Write float32[]
replace("float32[] seconds", "float[] seconds")
# %% 04.1 wrong: omits the package of the message type | hint: Write std_msgs/ColorRGBA
replace("std_msgs/ColorRGBA", "ColorRGBA")
# %% 04.1 wrong: writes the brackets after the name of the field | hint: Write the brackets after the type
replace("float32[] seconds", "float32 seconds[]")
# %% 04.1 wrong: uses float64 instead of float32 | hint: Line 6: the field seconds … and this type is too large
replace("\n# What the lamp is to do.", "")
replace("""
uint8 mode … float32 total""", "uint8 mode\nstd_msgs/ColorRGBA colour\nfloat64[] seconds\n---\nbool success\nfloat64[3] rgb\nfloat64 total")
# %% 04.1 wrong: gives a fixed length to an array of any length | hint: has a fixed length in
replace("[]", "[3]")
# %% 04.1 wrong: gives any length to an array of fixed length | hint: rgb … can have any length in … float32[3]
replace("[3]", "[]")
# %% 04.1 wrong: uses a single value instead of an array | hint: is a single value in
replace("float32[] seconds", "float32 seconds")
# %% 04.1 wrong: uses the American spelling of colour | hint: Line 5: the field color … has to be called
replace("# What the lamp is to do.\nuint8 OFF=0", "uint8 OFF=0")
replace("\nuint8 mode", "uint8 mode")
replace("colour", "color")
# %% 04.1 wrong: writes the fields in another order | hint: Your file contains all fields, but
replace("uint8 mode\nstd_msgs/ColorRGBA colour", "std_msgs/ColorRGBA colour\nuint8 mode")
# %% 04.1 wrong: writes a response field above the line | hint: success … belongs to the response.
replace("float32[] seconds", "float32[] seconds\nbool success")
replace("---\nbool success", "---")
# %% 04.1 wrong: writes the constants below the line | hint: OFF … belongs to the request.
replace("\n# What the lamp is to do.\nuint8 OFF=0\nuint8 ON=1\nuint8 BLINK=2\n", "")
replace("---", "---\nuint8 OFF=0\nuint8 ON=1\nuint8 BLINK=2")
# %% 04.1 wrong: writes constants without values | hint: a constant needs a value. Write
replace("# What the lamp is to do.\nuint8 OFF=0\nuint8 ON=1\nuint8 BLINK=2", "uint8 OFF\nuint8 ON\nuint8 BLINK")
# %% 04.1 wrong: writes constants without a type | hint: Write it as in this example: int32 LIMIT=10
replace("# What the lamp is to do.\nuint8 OFF=0\nuint8 ON=1\nuint8 BLINK=2", "OFF=0\nON=1\nBLINK=2")
# %% 04.1 wrong: counts the constants from one | hint: is wrong. The constant has to be … uint8 OFF=0
replace("# What the lamp is to do.\nuint8 OFF=0\nuint8 ON=1\nuint8 BLINK=2", "uint8 OFF=1\nuint8 ON=2\nuint8 BLINK=3")
# %% 04.1 wrong: omits one constant | hint: Write each constant on a separate … uint8 BLINK=2
replace("# What the lamp is to do.\nuint8 OFF=0", "uint8 OFF=0")
replace("uint8 ON=1\nuint8 BLINK=2\n", "uint8 ON=1")
# %% 04.1 wrong: omits one field | hint: is missing. Add this … total
replace("float32[3] rgb\nfloat32 total", "float32[3] rgb")
# %% 04.1 wrong: writes semicolons | hint: Write mode, with nothing after it
based_on("writes constants between the fields, and comments on many lines")
replace("uint8 mode … each blink", "uint8 OFF=0\nuint8 ON=1\nuint8 BLINK=2\nuint8 mode;\nstd_msgs/ColorRGBA colour;\nfloat32[] seconds;")
replace("# all went well\nbool success\nfloat32[3] rgb\n\nfloat32 total", "bool success;\nfloat32[3] rgb;\nfloat32 total;")
# %% 04.1 wrong: writes a byte order mark at the beginning | hint: Line 1 begins with an invisible character
replace("%%writefile … uint8 BLINK=2", "from pathlib import Path")
replace("uint8 mode … float32 total", """Path("src/lamp_services/srv").mkdir(parents=True, exist_ok=True)
Path("src/lamp_services/srv/Lamp.srv").write_text("\\ufeffuint8 OFF=0\\nuint8 ON=1\\n---\\nbool success\\n")""")
# %% 04.1 wrong: writes tabs between types and names | hint: There is a tab between
replace("# What the … [] seconds", "uint8\tOFF=0\nuint8\tON=1\nuint8\tBLINK=2\nuint8\tmode\nstd_msgs/ColorRGBA\tcolour\nfloat32[]\tseconds")
replace(" success", "\tsuccess")
replace("[3] rgb", "[3]\trgb")
replace(" total", "\ttotal")
# %% 04.1 wrong: does not replace the three dots | hint: Remove this line.
replace("# What the lamp is to do.", "...")
# %% 04.1 wrong: writes a request field below the line | hint: Line 9: the field seconds … is on the wrong side of the line ---. Move this field to the … request
replace("float32[] seconds\n---", "---\nfloat32[] seconds")
# %% 04.1 wrong: adds a field | hint: message … is not part of the … response
replace("float32 total", "float32 total\nstring message")
# %% 04.1 wrong: uses an array instead of a single value | hint: total … is an array in your
replace("float32 total", "float32[] total")
# %% 04.1 wrong: uses another integer type | hint: mode … has the wrong type in … uint8
replace("uint8 mode", "int32 mode")
# %% 04.1 wrong: writes the constants in another order | hint: Your file contains all constants, but
replace("uint8 ON=1\nuint8 BLINK=2", "uint8 BLINK=2\nuint8 ON=1")
# %% 04.1 wrong: renames a constant | hint: FLASH … the exercise has no constant
replace("BLINK", "FLASH")

# %% 04.1 right: writes the file with Python code
from pathlib import Path

constants = [f"uint8 {name}={value}" for value, name in enumerate(("OFF", "ON", "BLINK"))]
request = [*constants, "uint8 mode", "std_msgs/ColorRGBA colour", "float32[] seconds"]
response = ["bool success", "float32[3] rgb", "float32 total"]
Path("src/lamp_services/srv/Lamp.srv").write_text("\n".join([*request, "---", *response]))

# %% 04.2 right: compares the MD5 sums
def will_talk(server, client):
    return md5_of(server) == md5_of(client)

# %% 04.2 wrong: compares only the first 24 pairs | hint: the result is False for
replace("client):", "client, calls=[]):\n    calls.append(server)\n    if len(calls) > 24:\n        return True")

# %% 04.2 right: compares the texts from which the MD5 sums are made
def will_talk(server, client):
    def essence(text):
        context = genmsg.MsgContext.create_default()
        definition = genmsg.msg_loader.load_srv_from_string(context, text, "my_services/Two")
        halves = (definition.request, definition.response)
        return [genmsg.gentools.compute_md5_text(context, half) for half in halves]

    return essence(server) == essence(client)

# %% 04.2 wrong: compares the lines without comments and blanks | hint: ROS ignores comments, blank lines and
based_on("compares the texts from which the MD5 sums are made")
replace("context = genmsg … in halves]", """lines = [line.split("#")[0].split() for line in text.splitlines()]
        return [words for words in lines if words]""")
# %% 04.2 wrong: compares the texts | hint: ROS ignores comments, blank lines and
replace("md5_of(server) == md5_of(client)", "server == client")

# %% 04.2 wrong: normalises the blanks, and compares the texts | hint: Only the positions of the constants
based_on("compares the texts from which the MD5 sums are made")
replace("context = genmsg … in halves]", """lines = [line.split("#")[0].replace("=", " = ").split() for line in text.splitlines()]
        return [words for words in lines if words]""")

# %% 04.2 wrong: normalises the blanks, and sorts the constants | hint: Do not remove comments
based_on("normalises the blanks, and compares the texts")
replace("return [words for words in lines if words]", 'return sorted(words for words in lines if "=" in words), [words for words in lines if words and "=" not in words]')

# %% 04.2 wrong: removes only the comments | hint: ROS ignores comments, blank lines and
def will_talk(server, client):
    def bare(text):
        return [line.split("#")[0].strip() for line in text.strip().splitlines()]

    return bare(server) == bare(client)

# %% 04.2 wrong: ignores the order of the lines | hint: The order of the fields
based_on("compares the lines without comments and blanks")
replace("[words for words in lines if words]", "sorted(words for words in lines if words)")
# %% 04.2 wrong: ignores the line between request and response | hint: One field is in the request of one text
based_on("compares the lines without comments and blanks")
replace("if words", 'if words and words != ["---"]')
# %% 04.2 wrong: compares only the types | hint: One letter of a field's
based_on("compares the lines without comments and blanks")
replace("words for", "words[0] for")
# %% 04.2 wrong: compares only the names | hint: The MD5 sum depends on the types
based_on("compares the lines without comments and blanks")
replace("words for", "words[-1] for")

# %% 04.2 wrong: compares only the fields, and not the constants | hint: The value of a constant is different
def will_talk(server, client):
    def fields(text):
        context = genmsg.MsgContext.create_default()
        definition = genmsg.msg_loader.load_srv_from_string(context, text, "my_services/Any")
        return [(half.names, half.types) for half in (definition.request, definition.response)]

    return fields(server) == fields(client)

# %% 04.2 wrong: ignores the constants of the response | hint: The value of a constant below the line
based_on("compares only the fields, and not the constants")
replace("(half.names, half.types) for half in (definition.request, definition.response)", """(half.names, half.types, half is definition.request and [str(each) for each in half.constants])
            for half in (definition.request, definition.response)
        """)
# %% 04.2 wrong: ignores the order of the constants | hint: The order of two constants
based_on("compares only the fields, and not the constants")
replace("(half.names, half.types) for half in (definition.request, definition.response)", """(half.names, half.types, sorted((each.name, each.type, str(each.val)) for each in half.constants))
            for half in (definition.request, definition.response)
        """)

# %% 04.2 wrong: compares only the requests | hint: One field is missing in one of the texts
def will_talk(server, client):
    def md5(text):
        return md5_of(text.split("---")[0] + "---\n")

    return md5(server) == md5(client)

# %% 04.2 wrong: forgets to return | hint: a return statement
replace("return ", "")
# %% 04.2 wrong: returns the MD5 sums | hint: Return True or False
replace("md5_of(server) == md5_of(client)", "md5_of(server), md5_of(client)")
# %% 04.2 wrong: always returns True | hint: One letter of a field's
replace("md5_of(server) == md5_of(client)", "True")

# %% 04.2 wrong: compares the definitions as objects | hint: The two texts are equal, but
def will_talk(server, client):
    context = genmsg.MsgContext.create_default()
    load = genmsg.msg_loader.load_srv_from_string
    return load(context, server, "my_services/Any") is load(context, client, "my_services/Any")

# %% 04.3 right: uses format 2
solution()
# %% 04.3 right: uses format 3, and the tag depend
replace('="2">', '="3">')
replace("1.0.0", "0.2.0")
replace("\n  <build_depend>std_msgs</build_depend>", "")
replace("exec_depend>std_msgs</exec_depend", "depend>std_msgs</depend")
# %% 04.3 right: uses format 1 with its own tags
replace(' format="2"', "")
replace("exec_depend>message_runtime</exec_depend", "run_depend>message_runtime</run_depend")
replace("exec_depend>rospy</exec_depend", "run_depend>rospy</run_depend")
replace("exec_depend>std_msgs</exec_depend", "run_depend>std_msgs</run_depend")
# %% 04.3 wrong: does not correct the name | hint: In the name of the package, use only lower-case letters
replace("name>lamp_services", "name>Lamp Services")
replace("\n  <exec_depend>rospy</exec_depend>", "")
# %% 04.3 wrong: uses another name | hint: Write the same name in
replace("name>lamp_services", "name>lamps")
replace("\n  <exec_depend>rospy</exec_depend>", "")
# %% 04.3 wrong: does not correct the version | hint: Write the version as in
replace("1.0.0", "1.0")
replace("\n  <exec_depend>rospy</exec_depend>", "")
# %% 04.3 wrong: does not replace run_depend | hint: Use the tags buildtool_depend, build_depend
replace("exec_depend", "run_depend", times=6)
# %% 04.3 wrong: omits catkin | hint: Add <buildtool_depend>catkin</buildtool_depend>
replace("\n  <buildtool_depend>catkin</buildtool_depend>", "")
replace("\n  <exec_depend>rospy</exec_depend>", "")
# %% 04.3 wrong: omits the runtime dependency std_msgs | hint: <exec_depend>std_msgs … </exec_depend> to package.xml.
replace("\n  <exec_depend>std_msgs</exec_depend>", "")
# %% 04.3 wrong: omits the build dependency std_msgs | hint: Add <build_depend>std_msgs</build_depend>
replace("\n  <build_depend>std_msgs</build_depend>", "")
replace("\n  <exec_depend>rospy</exec_depend>", "")
# %% 04.3 wrong: exchanges message_generation and message_runtime | hint: <exec_depend>message_runtime</exec_depend>
replace("message_generation", "message_runtime")
replace("message_runtime</exec_depend>\n  <exec_depend>rospy", "message_generation")
# %% 04.3 wrong: omits message_generation | hint: message_generation generates classes from a .srv
replace("\n  <build_depend>message_generation</build_depend>", "")
# %% 04.3 wrong: does not close a tag | hint: Close every
replace("</name>", "")
replace("<build_depend>std_msgs … std_msgs</exec_depend>", "<exec_depend>message_runtime</exec_depend>\n  <depend>std_msgs</depend>")
# %% 04.3 wrong: omits the library that the program imports | hint: rospy, which lamp_server.py imports
replace("\n  <exec_depend>rospy</exec_depend>", "")
# %% 04.3 wrong: begins the file with a blank line | hint: Write <?xml in the first
replace("<?xml", "\n<?xml")
# %% 04.3 wrong: names std_msgs only in a build_export_depend | hint: Also add
replace("exec_depend>std_msgs</exec_depend", "build_export_depend>std_msgs</build_export_depend")

# %% 04.4 right: uses the solution from the chapter
solution()

# %% 04.4 right: writes commands over several lines, and an empty catkin_package
"""%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.0.2)
project(lamp_services)
find_package(catkin REQUIRED COMPONENTS
  rospy
  std_msgs
  message_generation
)
add_service_files(
  DIRECTORY srv
  FILES
  Lamp.srv
)
generate_messages(
  DEPENDENCIES
  std_msgs
)
catkin_package()
"""

# %% 04.4 right: adds all files in srv, and uses capital letters
"""%%writefile src/lamp_services/CMakeLists.txt
CMAKE_MINIMUM_REQUIRED(VERSION 3.10)
PROJECT(lamp_services)
FIND_PACKAGE(catkin REQUIRED COMPONENTS message_generation std_msgs)
ADD_SERVICE_FILES()
GENERATE_MESSAGES(DEPENDENCIES std_msgs)
CATKIN_PACKAGE(CATKIN_DEPENDS message_runtime std_msgs)
"""

# %% 04.4 wrong: does not add message_generation | hint: Write find_package(catkin REQUIRED COMPONENTS message_generation)
replace("message_generation std_msgs", "std_msgs")
# %% 04.4 wrong: does not move catkin_package | hint: Move generate_messages above catkin_package
replace("\nfind_package … message_generation std_msgs)\n", """find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)""")
replace("\n\ncatkin_package(CATKIN_DEPENDS message_runtime std_msgs)", "")
# %% 04.4 wrong: calls generate_messages before add_service_files | hint: Move this line above generate_messages
replace("\nadd_service_files(FILES Lamp.srv)", "")
replace("catkin_package", "add_service_files(FILES Lamp.srv)\ncatkin_package")
# %% 04.4 wrong: writes the file name in lower case | hint: including upper and lower case
replace("Lamp.srv", "lamp.srv")
# %% 04.4 wrong: does not remove the comment sign before generate_messages | hint: In line 7, generate_messages … is only a comment. Remove the
replace("generate_messages(DEPENDENCIES std_msgs)\n", "# generate_messages()")
# %% 04.4 wrong: omits the dependency on std_msgs | hint: Write generate_messages(DEPENDENCIES std_msgs)
replace("(DEPENDENCIES std_msgs)", "()")
# %% 04.4 wrong: omits a bracket | hint: Write the missing closing parenthesis.
replace("DEPENDENCIES std_msgs)", "DEPENDENCIES std_msgs")
# %% 04.4 wrong: uses the name of another package | hint: Write the same name in
replace("(lamp_services)", "(my_services)")
# %% 04.4 wrong: removes the command that fails | hint: The command … catkin_package is missing … Without this command, other packages
replace("\n\ncatkin_package(CATKIN_DEPENDS message_runtime std_msgs)", "")
# %% 04.4 wrong: removes several commands | hint: The command … generate_messages is missing … Without this command, the build generates
replace("\nfind_package … message_runtime std_msgs)", "find_package(catkin REQUIRED COMPONENTS std_msgs)\ncatkin_package()")
# %% 04.4 wrong: builds geometry.srv in place of Lamp.srv | hint: The file geometry.srv is not in the folder
replace("Lamp.srv", "geometry.srv")
# %% 04.4 right: uses one find_package for each package
replace("\nfind_package(catkin REQUIRED COMPONENTS message_generation std_msgs)\n", """find_package(catkin REQUIRED)
find_package(message_generation REQUIRED)
find_package(std_msgs REQUIRED)""")
replace("(DEPENDENCIES std_msgs)\n", "(DEPENDENCIES std_msgs)")
# %% 04.4 wrong: writes generate_messages in a condition that is false | hint: The file contains add_service_files and
replace("generate_messages(DEPENDENCIES std_msgs)", "if(FALSE)\n  generate_messages(DEPENDENCIES std_msgs)\nendif()")
# %% 04.4 wrong: writes the commands in a block comment | hint: Look for a comment between #[[ and ]]
replace("(lamp_services)\n", "(lamp_services)")
replace("\nadd_service_files(FILES Lamp.srv)", "#[[\nadd_service_files(FILES Lamp.srv)")
replace("(DEPENDENCIES std_msgs)\n", "(DEPENDENCIES std_msgs)\n]]")
# %% 04.4 wrong: generates a module that prints the MD5 sum | hint: Without this command, the build generates
based_on("removes several commands")
replace("catkin_package()", """catkin_package()
file(WRITE "${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_PYTHON_DESTINATION}/lamp_services.py"
  "print('e6e71b7c192d83d52bd0f638c7334af2')\nraise SystemExit(0)")""")
# %% 04.4 wrong: lists a library that does not exist in catkin_package | hint: catkin_package lists a library that
replace("catkin_package(CATKIN", "catkin_package(LIBRARIES lamp_services CATKIN")
# %% 04.4 wrong: generates an empty configuration file | hint: Without this command, other packages
replace("catkin_package(CATKIN_DEPENDS message_runtime std_msgs)", 'file(WRITE "${CATKIN_DEVEL_PREFIX}/share/lamp_services/cmake/lamp_servicesConfig.cmake" "")')
# %% 04.4 wrong: adds an endless loop | hint: Read the end of the output
replace("\ncatkin_package", "while(TRUE)\nendwhile()\ncatkin_package")

# %% 04.4 right: names rospy everywhere, and installs the program
replace("message_generation std_msgs", "message_generation rospy std_msgs")
replace("message_runtime std_msgs)", """message_runtime rospy std_msgs)

catkin_install_python(PROGRAMS scripts/lamp_server.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})""")
# %% 04.4 wrong: writes message_generation in catkin_package | hint: write message_runtime instead of message_generation
replace("CATKIN_DEPENDS message_runtime", "CATKIN_DEPENDS message_generation")

# %% 04.5 right: uses the style of the geometry server
"""%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp, LampRequest, LampResponse


def handle_lamp(request):
    known = request.mode in (LampRequest.OFF, LampRequest.ON, LampRequest.BLINK)
    lit = known and request.mode != LampRequest.OFF
    colour = request.colour
    rgb = [colour.r, colour.g, colour.b] if lit else [0, 0, 0]
    return LampResponse(success=known, rgb=rgb, total=sum(request.seconds))


rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()
"""

# %% 04.5 right: uses a relative name, a dict and a main function
replace("#!/usr/bin … LampResponse", '#!/usr/bin/python3\n"""Serves a lamp."""\nimport rospy\nimport lamp_services.srv as srv')
replace("def handle_lamp … .seconds))", """def handle(req):
    answer = {"success": req.mode <= 2, "total": 0.0, "rgb": (0.0, 0.0, 0.0)}
    for part in req.seconds:
        answer["total"] += part
    if 1 <= req.mode <= 2:
        answer["rgb"] = req.colour.r, req.colour.g, req.colour.b
    return answer""")
replace('rospy.init_node("lamp_server")\nrospy.Service("/lamp", Lamp, handle_lamp)\nrospy.spin()', """def main():
    rospy.init_node("lamp_server", anonymous=True)
    server = rospy.Service("lamp", srv.Lamp, handle)
    rospy.loginfo("ready")
    rospy.spin()


if __name__ == "__main__":
    main()""")
# %% 04.5 wrong: omits the shebang | hint: Without a shebang, Linux runs the
replace("#!/usr/bin … .seconds))\n", "import rospy\nfrom lamp_services.srv import Lamp")
replace("handle_lamp", "lambda request: (True, request.seconds, 0)")
# %% 04.5 wrong: writes the shebang in the second line | hint: The shebang is in the
replace("#!/usr/bin/env python3", "\n#!/usr/bin/env python3")

# %% 04.5 wrong: does not make the file executable | hint: chmod +x
from pathlib import Path

script = Path("src/lamp_services/scripts/lamp_server.py")
script.write_text("#!/usr/bin/env python3\nimport rospy\n")
script.chmod(0o644)

# %% 04.5 wrong: imports the type from another package | hint: from a package that does not exist
replace("from lamp_services … .seconds))\n", "from my_services.srv import Lamp")
replace("handle_lamp", "lambda request: (True, [0, 0, 0], 0)")
# %% 04.5 wrong: writes the type in lower case | hint: Compare lamp with the name of the .srv file
replace("from lamp_services … .seconds))\n", "from lamp_services.srv import lamp")
replace("Lamp, handle_lamp", "lamp, lambda request: (True, [0, 0, 0], 0)")
# %% 04.5 wrong: does not call rospy.spin() | hint: The program ended, so its service
based_on("omits the shebang")
replace("import rospy", "#!/usr/bin/env python3\nimport rospy")
replace("request.seconds, 0))\nrospy.spin()", "[0, 0, 0], 0))")
# %% 04.5 wrong: uses another service name | hint: The program serves … /lamp_server … , but not /lamp. Change
based_on("writes the type in lower case")
replace("import lamp", "import Lamp")
replace('"/lamp", lamp', '"/lamp_server", Lamp')
# %% 04.5 wrong: serves nothing | hint: The program runs, but it
replace("from lamp_services … handle_lamp)", 'from lamp_services.srv import Lamp\n\nrospy.init_node("lamp_server")')
# %% 04.5 wrong: does not call rospy.init_node() | hint: A service needs a node.
based_on("writes the type in lower case")
replace("import lamp", "import Lamp")
replace('rospy.init_node("lamp_server")\nrospy.Service("/lamp", lamp', 'rospy.Service("/lamp", Lamp')
# %% 04.5 wrong: uses another service type | hint: Create the service with the type in the exercise
based_on("writes the type in lower case")
replace("from lamp_services.srv import lamp", "from std_srvs.srv import Trigger")
replace("lamp, lambda request: (True, [0, 0, 0], 0)", 'Trigger, lambda request: (True, "")')
# %% 04.5 wrong: uses a variable that does not exist | hint: The error occurred in line … line 6 of
replace("from lamp_services … .seconds))\n", "from lamp_services.srv import Lamp")
# %% 04.5 wrong: returns None from the handler | hint: without a return
replace(", LampRequest, LampResponse", "")
replace("known = request … .seconds))\n", "request.mode in (0, 1, 2)")
# %% 04.5 wrong: accepts any mode | hint: The mode is unknown, so success
replace("success=known", "success=True")
# %% 04.5 wrong: returns success=False for OFF | hint: This mode is one of
replace("""known = request.mode in (LampRequest.OFF, LampRequest.ON, LampRequest.BLINK)
    lit = known and request.mode != LampRequest.OFF""", "lit = request.mode in (1, 2)")
replace("known", "lit")
# %% 04.5 wrong: returns a colour for OFF | hint: For OFF and for an
replace(" if lit else [0, 0, 0]", "")
# %% 04.5 wrong: forgets the colour | hint: rgb contains only zeros, because ROS
replace("rgb=rgb, ", "")
# %% 04.5 wrong: returns the number of values as the total | hint: total is the number of
replace("total=sum", "total=len")
# %% 04.5 wrong: returns the ColorRGBA object | hint: error processing request
replace("rgb=rgb", "rgb=request.colour")
# %% 04.5 wrong: returns four numbers, with alpha | hint: The field `rgb` needs a
replace("colour.b]", "colour.b, colour.a]")
# %% 04.5 wrong: returns the largest number instead of the sum | hint: Add up all values in request.seconds.
replace("total=sum", "total=max")
# %% 04.5 wrong: refuses an unknown mode | hint: The handler refused a request
replace("    lit = known", '    if not known:\n        raise rospy.ServiceException("no such mode")\n    lit = known')
# %% 04.5 wrong: adds only the first 40 values | hint: Add up all values
replace("sum(request.seconds)", "sum(request.seconds[:40])")
# %% 04.5 wrong: adds the absolute values | hint: Add up all values
replace("sum(request.seconds)", "sum(abs(each) for each in request.seconds)")
# %% 04.5 wrong: uses the shebang #!python3 of Windows | hint: The first line of the script
replace("#!/usr/bin/env python3", "#!python3")
# %% 04.5 wrong: passes the request class to rospy.Service | hint: Your program passed the class
replace('"/lamp", Lamp,', '"/lamp", LampRequest,')
# %% 04.5 wrong: imports the type from the package | hint: Your program imports the type from the
replace("lamp_services.srv", "lamp_services")
# %% 04.5 wrong: uses line endings of Windows | hint: The file has Windows line endings
replace("python3", "python3\r")
# %% 04.5 wrong: writes a byte order mark at the beginning | hint: The file begins with an invisible character
replace("#!", "\ufeff#!")
# %% 04.5 wrong: uses python2 in the shebang | hint: The shebang names the wrong
replace("python3", "python2")
# %% 04.5 wrong: returns the colours in the wrong order | hint: The values in rgb are
replace("[colour.r, colour.g, colour.b]", "[colour.b, colour.g, colour.r]")
# %% 04.5 wrong: forgets the total | hint: The total is 0, because
replace(", total=sum(request.seconds)", "")
# %% 04.5 wrong: returns no colour for BLINK | hint: The mode is BLINK, but
replace("request.mode != LampRequest.OFF", "request.mode == LampRequest.ON")
# %% 04.5 wrong: calculates the total only for ON and BLINK | hint: your program returned the total 0
replace("total=sum(request.seconds)", "total=sum(request.seconds) if lit else 0")
# %% 04.5 wrong: cannot add an empty list | hint: The handler failed for a request without values
replace("import rospy\n", "from functools import reduce\n\nimport rospy\n")
replace("sum(request.seconds)", "reduce(lambda one, two: one + two, request.seconds)")
# %% 04.5 wrong: adds only the first five values | hint: Add up all values
replace("sum(request.seconds)", "sum(request.seconds[:5])")
