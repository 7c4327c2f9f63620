"""What students write in the exercises of chapter 04."""

# %% before
from course_pkg import join

node = join("chapter_04")

# %% 04.1 right: as described
%%writefile src/lamp_services/srv/Lamp.srv
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

# %% 04.1 right: constants between the fields, blanks and comments everywhere
%%writefile src/lamp_services/srv/Lamp.srv
uint8 mode   # one of the three:
uint8 OFF = 0
uint8  ON = 1    # steady
uint8 BLINK =2

std_msgs/ColorRGBA   colour
float32[] seconds # of each blink
---
# all went well
bool success
float32[3] rgb

float32 total

# %% 04.1 wrong: dashes with blanks between | hint: This is no line of three dashes
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode
std_msgs/ColorRGBA colour
float32[] seconds
- - -
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: no line between the halves | hint: Add a line of three dashes
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode
std_msgs/ColorRGBA colour
float32[] seconds
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: float as in other languages | hint: Write float32[]
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode
std_msgs/ColorRGBA colour
float[] seconds
---
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: the message without its package | hint: Write std_msgs/ColorRGBA
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode
ColorRGBA colour
float32[] seconds
---
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: brackets behind the name | hint: Write the brackets behind the type
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode
std_msgs/ColorRGBA colour
float32 seconds[]
---
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: wider numbers | hint: Line 6: seconds is twice as wide as asked for
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode
std_msgs/ColorRGBA colour
float64[] seconds
---
bool success
float64[3] rgb
float64 total

# %% 04.1 wrong: a fixed length where any will do | hint: Empty brackets take any number
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode
std_msgs/ColorRGBA colour
float32[3] seconds
---
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: any length where it is fixed | hint: Exactly three is float32[3]
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode
std_msgs/ColorRGBA colour
float32[] seconds
---
bool success
float32[] rgb
float32 total

# %% 04.1 wrong: one value for an array | hint: An array has brackets behind its type
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode
std_msgs/ColorRGBA colour
float32 seconds
---
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: spelt as in America | hint: Line 5: color should be colour
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode
std_msgs/ColorRGBA color
float32[] seconds
---
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: in another order | hint: Put the lines into the order of the description
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
std_msgs/ColorRGBA colour
uint8 mode
float32[] seconds
---
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: the answer stands above the line | hint: success belongs to the response: below the line
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode
std_msgs/ColorRGBA colour
float32[] seconds
bool success
---
float32[3] rgb
float32 total

# %% 04.1 wrong: the constants below the line | hint: OFF belongs to the request
%%writefile src/lamp_services/srv/Lamp.srv
uint8 mode
std_msgs/ColorRGBA colour
float32[] seconds
---
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: constants without values | hint: a constant has a value
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF
uint8 ON
uint8 BLINK
uint8 mode
std_msgs/ColorRGBA colour
float32[] seconds
---
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: constants without a type | hint: Write it as in int32 LIMIT=10
%%writefile src/lamp_services/srv/Lamp.srv
OFF=0
ON=1
BLINK=2
uint8 mode
std_msgs/ColorRGBA colour
float32[] seconds
---
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: counts from one | hint: should be uint8 OFF=0
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=1
uint8 ON=2
uint8 BLINK=3
uint8 mode
std_msgs/ColorRGBA colour
float32[] seconds
---
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: one constant is missing | hint: such as uint8 BLINK=2
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 mode
std_msgs/ColorRGBA colour
float32[] seconds
---
bool success
float32[3] rgb
float32 total

# %% 04.1 wrong: a field is missing | hint: There is no field total
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode
std_msgs/ColorRGBA colour
float32[] seconds
---
bool success
float32[3] rgb

# %% 04.1 wrong: semicolons | hint: Write mode, with nothing behind it
%%writefile src/lamp_services/srv/Lamp.srv
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2
uint8 mode;
std_msgs/ColorRGBA colour;
float32[] seconds;
---
bool success;
float32[3] rgb;
float32 total;

# %% 04.1 wrong: a mark of Windows in front | hint: without BOM
from pathlib import Path

Path("src/lamp_services/srv").mkdir(parents=True)
Path("src/lamp_services/srv/Lamp.srv").write_text("\ufeffuint8 OFF=0\nuint8 ON=1\n---\nbool success\n")

# %% 04.1 wrong: tabs | hint: To ROS only blanks part words
%%writefile src/lamp_services/srv/Lamp.srv
uint8	OFF=0
uint8	ON=1
uint8	BLINK=2
uint8	mode
std_msgs/ColorRGBA	colour
float32[]	seconds
---
bool	success
float32[3]	rgb
float32	total

# %% 04.2 before
from course_pkg.interfaces import compile_service

# %% 04.2 right: the MD5s
def will_talk(server, client):
    return compile_service("my_services/One", server).md5 == compile_service("my_services/Two", client).md5

# %% 04.2 right: the classes
def will_talk(server, client):
    one, other = (compile_service("my_services/Any", text).cls._md5sum for text in (server, client))
    return one == other

# %% 04.2 right: what is left without comments and blanks
def will_talk(server, client):
    def essence(text):
        lines = [line.split("#")[0].split() for line in text.splitlines()]
        return [words for words in lines if words]

    return essence(server) == essence(client)

# %% 04.2 wrong: compares the texts | hint: Comments, blank lines and extra blanks are for people
def will_talk(server, client):
    return server == client

# %% 04.2 wrong: strips the comments only | hint: Comments, blank lines and extra blanks are for people
def will_talk(server, client):
    def bare(text):
        return [line.split("#")[0].strip() for line in text.strip().splitlines()]

    return bare(server) == bare(client)

# %% 04.2 wrong: the order does not matter | hint: The order of the fields
def will_talk(server, client):
    def essence(text):
        lines = [line.split("#")[0].split() for line in text.splitlines()]
        return sorted(words for words in lines if words)

    return essence(server) == essence(client)

# %% 04.2 wrong: forgets the line between the halves | hint: request and response are two lists
def will_talk(server, client):
    def essence(text):
        lines = [line.split("#")[0].split() for line in text.splitlines()]
        return [words for words in lines if words and words != ["---"]]

    return essence(server) == essence(client)

# %% 04.2 wrong: the types only | hint: The name of every field
def will_talk(server, client):
    def essence(text):
        lines = [line.split("#")[0].split() for line in text.splitlines()]
        return [words[0] for words in lines if words]

    return essence(server) == essence(client)

# %% 04.2 wrong: the names only | hint: A type is part of the MD5
def will_talk(server, client):
    def essence(text):
        lines = [line.split("#")[0].split() for line in text.splitlines()]
        return [words[-1] for words in lines if words]

    return essence(server) == essence(client)

# %% 04.2 wrong: the fields only, from the classes | hint: A constant is agreed on
def will_talk(server, client):
    def fields(text):
        cls = compile_service("my_services/Any", text).cls
        halves = (cls._request_class, cls._response_class)
        return [(half.__slots__, half._slot_types) for half in halves]

    return fields(server) == fields(client)

# %% 04.2 wrong: the request only | hint: in both halves
def will_talk(server, client):
    def md5(text):
        return compile_service("my_services/Any", text.split("---")[0] + "---\n").md5

    return md5(server) == md5(client)

# %% 04.2 wrong: forgets to return | hint: a return line
def will_talk(server, client):
    compile_service("my_services/One", server).md5 == compile_service("my_services/One", client).md5

# %% 04.2 wrong: returns the MD5s | hint: Return True or False
def will_talk(server, client):
    return compile_service("my_services/One", server).md5, compile_service("my_services/One", client).md5

# %% 04.2 wrong: always | hint: The name of every field
def will_talk(server, client):
    return True

# %% 04.3 right: format 2
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="2">
  <name>lamp_services</name>
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>

  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <build_depend>std_msgs</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <exec_depend>rospy</exec_depend>
  <exec_depend>std_msgs</exec_depend>
</package>

# %% 04.3 right: format 3 and depend
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="3">
  <name>lamp_services</name>
  <version>0.2.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>

  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <depend>std_msgs</depend>
</package>

# %% 04.3 right: format 1, as its tags were meant
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package>
  <name>lamp_services</name>
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>

  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <build_depend>std_msgs</build_depend>
  <run_depend>message_runtime</run_depend>
  <run_depend>rospy</run_depend>
  <run_depend>std_msgs</run_depend>
</package>

# %% 04.3 wrong: the name as before | hint: Write it in lower-case letters
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="2">
  <name>Lamp Services</name>
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <build_depend>std_msgs</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <exec_depend>std_msgs</exec_depend>
</package>

# %% 04.3 wrong: another name | hint: Write one name in both
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="2">
  <name>lamps</name>
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <build_depend>std_msgs</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <exec_depend>std_msgs</exec_depend>
</package>

# %% 04.3 wrong: the version as before | hint: Write it as in 0.1.0
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="2">
  <name>lamp_services</name>
  <version>1.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <build_depend>std_msgs</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <exec_depend>std_msgs</exec_depend>
</package>

# %% 04.3 wrong: run_depend as before | hint: Formats 2 and 3 have buildtool_depend
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="2">
  <name>lamp_services</name>
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <build_depend>std_msgs</build_depend>
  <run_depend>message_runtime</run_depend>
  <run_depend>rospy</run_depend>
  <run_depend>std_msgs</run_depend>
</package>

# %% 04.3 wrong: catkin is not named | hint: Add <buildtool_depend>catkin</buildtool_depend>
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="2">
  <name>lamp_services</name>
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <build_depend>message_generation</build_depend>
  <build_depend>std_msgs</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <exec_depend>std_msgs</exec_depend>
</package>

# %% 04.3 wrong: std_msgs not needed to run | hint: <exec_depend>std_msgs</exec_depend>
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="2">
  <name>lamp_services</name>
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <build_depend>std_msgs</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <exec_depend>rospy</exec_depend>
</package>

# %% 04.3 wrong: std_msgs not needed to build, which catkin notices | hint: Add <build_depend>std_msgs</build_depend>
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="2">
  <name>lamp_services</name>
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <exec_depend>std_msgs</exec_depend>
</package>

# %% 04.3 wrong: generation and runtime the wrong way round | hint: <exec_depend>message_runtime</exec_depend>
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="2">
  <name>lamp_services</name>
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_runtime</build_depend>
  <build_depend>std_msgs</build_depend>
  <exec_depend>message_generation</exec_depend>
  <exec_depend>std_msgs</exec_depend>
</package>

# %% 04.3 wrong: message_generation lost on the way | hint: becomes classes by message_generation
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="2">
  <name>lamp_services</name>
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <exec_depend>message_runtime</exec_depend>
  <depend>std_msgs</depend>
</package>

# %% 04.3 wrong: a tag left open | hint: Close every
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="2">
  <name>lamp_services
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <depend>std_msgs</depend>
</package>

# %% 04.3 wrong: a blank line on top | hint: in the first column of the first line
%%writefile src/lamp_services/package.xml

<?xml version="1.0"?>
<package format="2">
  <name>lamp_services</name>
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <depend>std_msgs</depend>
</package>

# %% 04.3 wrong: exports it | hint: Add an exec_depend
%%writefile src/lamp_services/package.xml
<?xml version="1.0"?>
<package format="2">
  <name>lamp_services</name>
  <version>1.0.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <build_depend>std_msgs</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <exec_depend>rospy</exec_depend>
  <build_export_depend>std_msgs</build_export_depend>
</package>

# %% 04.4 right: as in the chapter
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)

find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)

add_service_files(FILES Lamp.srv)
generate_messages(DEPENDENCIES std_msgs)

catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.4 right: over several lines, with rospy, and nothing in catkin_package
%%writefile src/lamp_services/CMakeLists.txt
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

# %% 04.4 right: whatever lies in srv, in capitals
%%writefile src/lamp_services/CMakeLists.txt
CMAKE_MINIMUM_REQUIRED(VERSION 3.10)
PROJECT(lamp_services)
FIND_PACKAGE(catkin REQUIRED COMPONENTS message_generation std_msgs)
ADD_SERVICE_FILES()
GENERATE_MESSAGES(DEPENDENCIES std_msgs)
CATKIN_PACKAGE(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.4 wrong: message_generation still missing | hint: Write find_package(catkin REQUIRED COMPONENTS message_generation)
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)
find_package(catkin REQUIRED COMPONENTS std_msgs)
add_service_files(FILES Lamp.srv)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.4 wrong: catkin_package still first | hint: Move generate_messages above catkin_package
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)
add_service_files(FILES Lamp.srv)
generate_messages(DEPENDENCIES std_msgs)

# %% 04.4 wrong: generates before the files are named | hint: Move this line above generate_messages
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)
generate_messages(DEPENDENCIES std_msgs)
add_service_files(FILES Lamp.srv)
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.4 wrong: the file in lower case | hint: upper and lower case too
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)
add_service_files(FILES lamp.srv)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.4 wrong: generate_messages still a comment | hint: Line 7: generate_messages is only a comment. Take the # away
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)

find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)

add_service_files(FILES Lamp.srv)
# generate_messages()
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.4 wrong: does not depend on std_msgs | hint: Write generate_messages(DEPENDENCIES std_msgs)
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)
add_service_files(FILES Lamp.srv)
generate_messages()
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.4 wrong: a bracket missing | hint: Write the missing )
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)
add_service_files(FILES Lamp.srv)
generate_messages(DEPENDENCIES std_msgs
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.4 wrong: the other package's name | hint: Write one name in both
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(my_services)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)
add_service_files(FILES Lamp.srv)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.4 wrong: takes out what complains | hint: There is no catkin_package
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)
add_service_files(FILES Lamp.srv)
generate_messages(DEPENDENCIES std_msgs)

# %% 04.4 wrong: takes out even more | hint: There is no generate_messages
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)
find_package(catkin REQUIRED COMPONENTS std_msgs)
catkin_package()

# %% 04.4 wrong: builds the geometry in its place | hint: There is no file geometry.srv
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)
add_service_files(FILES geometry.srv)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.4 right: each package by itself
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)
find_package(catkin REQUIRED)
find_package(message_generation REQUIRED)
find_package(std_msgs REQUIRED)
add_service_files(FILES Lamp.srv)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.4 wrong: in a condition | hint: between if() and endif()
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)
add_service_files(FILES Lamp.srv)
if(FALSE)
  generate_messages(DEPENDENCIES std_msgs)
endif()
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.4 wrong: block comment | hint: #[[ and ]] is a comment
%%writefile src/lamp_services/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(lamp_services)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)
#[[
add_service_files(FILES Lamp.srv)
generate_messages(DEPENDENCIES std_msgs)
]]
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

# %% 04.5 before
from pathlib import Path

script = Path("src/lamp_services/scripts/lamp_server.py")
script.parent.mkdir(parents=True, exist_ok=True)
script.touch()
script.chmod(0o755)

# %% 04.5 right: as the box server
%%writefile src/lamp_services/scripts/lamp_server.py
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

# %% 04.5 right: a relative name, a dict and a main function
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/python3
"""Serves a lamp."""
import rospy
import lamp_services.srv as srv


def handle(req):
    answer = {"success": req.mode <= 2, "total": 0.0, "rgb": (0.0, 0.0, 0.0)}
    for part in req.seconds:
        answer["total"] += part
    if 1 <= req.mode <= 2:
        answer["rgb"] = req.colour.r, req.colour.g, req.colour.b
    return answer


def main():
    rospy.init_node("lamp_server", anonymous=True)
    server = rospy.Service("lamp", srv.Lamp, handle)
    rospy.loginfo("ready")
    rospy.spin()


if __name__ == "__main__":
    main()

# %% 04.5 wrong: no shebang | hint: Linux gives the script to the shell
%%writefile src/lamp_services/scripts/lamp_server.py
import rospy
from lamp_services.srv import Lamp

rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, lambda request: (True, request.seconds, 0))
rospy.spin()

# %% 04.5 wrong: the shebang in the second line | hint: only as the very first line
%%writefile src/lamp_services/scripts/lamp_server.py

#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp

rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, lambda request: (True, request.seconds, 0))
rospy.spin()

# %% 04.5 wrong: the run bit is missing | hint: chmod +x
from pathlib import Path

script = Path("src/lamp_services/scripts/lamp_server.py")
script.write_text("#!/usr/bin/env python3\nimport rospy\n")
script.chmod(0o644)

# %% 04.5 wrong: the types of the other package | hint: import from lamp_services.srv
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from my_services.srv import Lamp

rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, lambda request: (True, [0, 0, 0], 0))
rospy.spin()

# %% 04.5 wrong: the type in lower case | hint: upper and lower case differ
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import lamp

rospy.init_node("lamp_server")
rospy.Service("/lamp", lamp, lambda request: (True, [0, 0, 0], 0))
rospy.spin()

# %% 04.5 wrong: does not wait | hint: Does it come to rospy.spin()
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp

rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, lambda request: (True, [0, 0, 0], 0))

# %% 04.5 wrong: another address | hint: It serves /lamp_server
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp

rospy.init_node("lamp_server")
rospy.Service("/lamp_server", Lamp, lambda request: (True, [0, 0, 0], 0))
rospy.spin()

# %% 04.5 wrong: serves nothing | hint: It is a node, and serves nothing
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp

rospy.init_node("lamp_server")
rospy.spin()

# %% 04.5 wrong: is no node | hint: call rospy.init_node first
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp

rospy.Service("/lamp", Lamp, lambda request: (True, [0, 0, 0], 0))
rospy.spin()

# %% 04.5 wrong: another type | hint: Serve it with the type that the exercise names
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from std_srvs.srv import Trigger

rospy.init_node("lamp_server")
rospy.Service("/lamp", Trigger, lambda request: (True, ""))
rospy.spin()

# %% 04.5 wrong: a slip in Python | hint: The error comes from line 6
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp

rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()

# %% 04.5 wrong: the handler returns nothing | hint: without a return
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp


def handle_lamp(request):
    request.mode in (0, 1, 2)


rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()

# %% 04.5 wrong: any mode will do | hint: There is no such mode
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp, LampResponse


def handle_lamp(request):
    colour = request.colour
    rgb = [colour.r, colour.g, colour.b] if request.mode in (1, 2) else [0, 0, 0]
    return LampResponse(success=True, rgb=rgb, total=sum(request.seconds))


rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()

# %% 04.5 wrong: OFF counts as no | hint: 0 counts as False in Python
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp, LampResponse


def handle_lamp(request):
    lit = request.mode in (1, 2)
    colour = request.colour
    rgb = [colour.r, colour.g, colour.b] if lit else [0, 0, 0]
    return LampResponse(success=lit, rgb=rgb, total=sum(request.seconds))


rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()

# %% 04.5 wrong: lit when it is off | hint: The lamp is dark when it is OFF
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp, LampResponse


def handle_lamp(request):
    colour = request.colour
    rgb = [colour.r, colour.g, colour.b]
    return LampResponse(success=request.mode in (0, 1, 2), rgb=rgb, total=sum(request.seconds))


rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()

# %% 04.5 wrong: forgets the colour | hint: Take r, g and b out of request.colour
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp, LampResponse


def handle_lamp(request):
    return LampResponse(success=request.mode in (0, 1, 2), total=sum(request.seconds))


rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()

# %% 04.5 wrong: counts the seconds | hint: That is how many there are
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp, LampResponse


def handle_lamp(request):
    colour = request.colour
    rgb = [colour.r, colour.g, colour.b] if request.mode in (1, 2) else [0, 0, 0]
    return LampResponse(success=request.mode in (0, 1, 2), rgb=rgb, total=len(request.seconds))


rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()

# %% 04.5 wrong: gives the colour whole | hint: error processing request
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp, LampResponse


def handle_lamp(request):
    return LampResponse(success=request.mode in (0, 1, 2), rgb=request.colour, total=sum(request.seconds))


rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()

# %% 04.5 wrong: alpha too | hint: rgb takes three numbers
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp, LampRequest, LampResponse


def handle_lamp(request):
    lit = request.mode in (LampRequest.ON, LampRequest.BLINK)
    colour = request.colour
    return LampResponse(
        success=lit or request.mode == LampRequest.OFF,
        rgb=[colour.r, colour.g, colour.b, colour.a] if lit else [0, 0, 0],
        total=sum(request.seconds),
    )


rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()

# %% 04.5 wrong: max | hint: Add up all of them
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp, LampRequest, LampResponse


def handle_lamp(request):
    lit = request.mode in (LampRequest.ON, LampRequest.BLINK)
    colour = request.colour
    return LampResponse(
        success=lit or request.mode == LampRequest.OFF,
        rgb=[colour.r, colour.g, colour.b] if lit else [0, 0, 0],
        total=max(request.seconds),
    )


rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()

# %% 04.5 wrong: refuses | hint: It is not refused
%%writefile src/lamp_services/scripts/lamp_server.py
#!/usr/bin/env python3
import rospy
from lamp_services.srv import Lamp, LampRequest, LampResponse


def handle_lamp(request):
    if request.mode > 2:
        raise rospy.ServiceException("no such mode")
    lit = request.mode in (LampRequest.ON, LampRequest.BLINK)
    colour = request.colour
    return LampResponse(
        success=lit or request.mode == LampRequest.OFF,
        rgb=[colour.r, colour.g, colour.b] if lit else [0, 0, 0],
        total=sum(request.seconds),
    )


rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()

# %% 04.5 wrong: windows shebang | hint: names a program that is not here
%%writefile src/lamp_services/scripts/lamp_server.py
#!python3
import rospy
from lamp_services.srv import Lamp, LampRequest, LampResponse


def handle_lamp(request):
    lit = request.mode in (LampRequest.ON, LampRequest.BLINK)
    colour = request.colour
    return LampResponse(
        success=lit or request.mode == LampRequest.OFF,
        rgb=[colour.r, colour.g, colour.b] if lit else [0, 0, 0],
        total=sum(request.seconds),
    )


rospy.init_node("lamp_server")
rospy.Service("/lamp", Lamp, handle_lamp)
rospy.spin()
