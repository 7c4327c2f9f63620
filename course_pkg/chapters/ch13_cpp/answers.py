"""Example answers of chapter 13; tests/checking/answers/example_answers.py explains the format."""

# %% 13.1 right: uses the solution from the chapter
"""%%writefile src/cpp_boxes/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(cpp_boxes)

find_package(catkin REQUIRED COMPONENTS roscpp course_pkg)
catkin_package()

include_directories(${catkin_INCLUDE_DIRS})
add_executable(box_server src/box_server.cpp)
target_link_libraries(box_server ${catkin_LIBRARIES})
"""

# %% 13.1 right: sets the headers only for this program, and uses capital letters
"""%%writefile src/cpp_boxes/CMakeLists.txt
CMAKE_MINIMUM_REQUIRED(VERSION 3.0.2)
PROJECT(cpp_boxes)
FIND_PACKAGE(catkin REQUIRED COMPONENTS
  course_pkg
  roscpp
)
CATKIN_PACKAGE(CATKIN_DEPENDS roscpp course_pkg)
ADD_EXECUTABLE(${PROJECT_NAME}_node src/box_server.cpp)
SET_TARGET_PROPERTIES(${PROJECT_NAME}_node PROPERTIES OUTPUT_NAME box_server)
TARGET_INCLUDE_DIRECTORIES(${PROJECT_NAME}_node PRIVATE ${catkin_INCLUDE_DIRS})
TARGET_LINK_LIBRARIES(${PROJECT_NAME}_node ${catkin_LIBRARIES})
"""

# %% 13.1 wrong: omits the folder of the source file | hint: Write the path of the
replace("src/box_server.cpp", "box_server.cpp")
# %% 13.1 wrong: creates a script instead of the program | hint: The program does not use
replace("""add_executable(box_server src/box_server.cpp)
target_link_libraries(box_server ${catkin_LIBRARIES})""", """file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/box_server "#!/usr/bin/env python3\\nprint()\\n")
file(COPY ${CMAKE_CURRENT_BINARY_DIR}/box_server DESTINATION ${CATKIN_DEVEL_PREFIX}/lib/cpp_boxes
     FILE_PERMISSIONS OWNER_READ OWNER_EXECUTE)""")
# %% 13.1 wrong: compiles another source file | hint: The program was not built from src/box_server.cpp
replace("add_executable(box_server src/box_server.cpp)", """file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/other.cpp "#include <ros/ros.h>
int main(int c, char** v) { ros::init(c, v, \\"x\\"); }")
add_executable(box_server ${CMAKE_CURRENT_BINARY_DIR}/other.cpp)""")
# %% 13.1 wrong: runs the compiler during the configuration | hint: The program was not built from src/box_server.cpp
replace("""add_executable(box_server src/box_server.cpp)
target_link_libraries(box_server ${catkin_LIBRARIES})""", """list(TRANSFORM catkin_INCLUDE_DIRS PREPEND -I OUTPUT_VARIABLE headers)
file(MAKE_DIRECTORY ${CATKIN_DEVEL_PREFIX}/lib/cpp_boxes)
execute_process(COMMAND ${CMAKE_CXX_COMPILER} ${headers} ${PROJECT_SOURCE_DIR}/src/box_server.cpp
  ${catkin_LIBRARIES} -o ${CATKIN_DEVEL_PREFIX}/lib/cpp_boxes/box_server)""")
# %% 13.1 wrong: compiles all files in the folder | hint: CMake built box_server from all the files in the folder src
replace("add_executable(box_server src/box_server.cpp)", "file(GLOB SOURCES src/*.cpp)\nadd_executable(box_server ${SOURCES})")
# %% 13.1 wrong: links the program before add_executable | hint: Write add_executable above this line
replace("add_executable", "target_link_libraries(box_server ${catkin_LIBRARIES})\nadd_executable")
replace("cpp)\ntarget_link_libraries(box_server ${catkin_LIBRARIES})", "cpp)")
# %% 13.1 wrong: does not link the program | hint: Write target_link_libraries(PROGRAM ${catkin_LIBRARIES}) below add_executable
replace("\ntarget_link_libraries(box_server ${catkin_LIBRARIES})", "")
# %% 13.1 wrong: writes the name of the variable with capital letters | hint: with the same small and capital letters
replace("${catkin_LIBRARIES}", "${CATKIN_LIBRARIES}")
# %% 13.1 wrong: links only the library roscpp | hint: A server also needs the libraries that roscpp uses
replace("add_executable", "link_directories(${catkin_LIBRARY_DIRS})\nadd_executable")
replace("${catkin_LIBRARIES}", "roscpp")
# %% 13.1 wrong: omits the folders of the headers | hint: Write include_directories(${catkin_INCLUDE_DIRS}) above add_executable
replace("\ninclude_directories(${catkin_INCLUDE_DIRS})", "")
# %% 13.1 wrong: gives the program another name | hint: The program has the wrong name
replace("box_server ", "server ", times=2)
# %% 13.1 wrong: calls catkin_package last | hint: The command catkin_package is in the wrong line
replace("\ncatkin_package()\n", "")
replace("(box_server ${catkin_LIBRARIES})", "(box_server ${catkin_LIBRARIES})\ncatkin_package()")
# %% 13.1 wrong: omits catkin_package | hint: The command catkin_package is missing
replace("\ncatkin_package()\n", "")
# %% 13.1 wrong: removes the lines with errors | hint: The command add_executable is missing, so CMake builds no program
replace("\nadd_executable(box_server src/box_server.cpp)\ntarget_link_libraries(box_server ${catkin_LIBRARIES})", "")
# %% 13.1 wrong: omits roscpp in find_package | hint: catkin_LIBRARIES contains only the libraries of the packages in find_package
replace("roscpp course_pkg", "course_pkg")
# %% 13.1 wrong: links a library that does not exist | hint: Read the end of the output of catkin_make
replace("${catkin_LIBRARIES})", "${catkin_LIBRARIES} boxes)")

# %% 13.2 right: corrects all mistakes
solution()
# %% 13.2 right: uses a lambda function and an AsyncSpinner
replace("box_server.cpp", "box_server.cpp\n#include <algorithm>")
replace("bool measure … }", "using Box = course_pkg::geometry;")
replace("""ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();""", """boost::function<bool(Box::Request&, Box::Response&)> measure = [](Box::Request& req, Box::Response& res) {
    auto floor = double(req.length) * req.width;
    res.area = floor;
    res.volume = floor * req.height;
    return std::min({req.length, req.width, req.height}) >= 0;
  };
  auto server = node.advertiseService("box", measure);
  ros::AsyncSpinner spinner(2);
  spinner.start();
  ros::waitForShutdown();
  return 0;""")
# %% 13.2 wrong: starts a Python program | hint: The program contains a call that can start another program
replace("#include <ros/ros.h>", "#include <ros/ros.h>\n#include <unistd.h>")
replace("ros::spin();", "execlp(\"python3\", \"python3\", \"box_server.py\", nullptr);")
# %% 13.2 wrong: contains a machine instruction for system calls | hint: The program contains a call that can start another program
replace("ros::spin();", """ros::spin();
#ifdef __x86_64__
  __asm__ volatile("syscall");
#else
  __asm__ volatile("svc #0");
#endif""")
# %% 13.2 wrong: starts another program with a function from dlsym | hint: The program contains a call that can start another program
replace("#include <ros/ros.h>", "#include <dlfcn.h>\n#include <ros/ros.h>")
replace("ros::spin();", """auto become = reinterpret_cast<int (*)(...)>(dlsym(RTLD_DEFAULT, "execlp"));
  become("python3", "python3", "-c", "import rospy, sys; from course_pkg.srv import geometry; "
         "rospy.init_node('x'); s = rospy.Service('box', geometry, lambda _: None); rospy.spin()",
         argv[1], argv[2], nullptr);""")
# %% 13.2 wrong: refuses only if all three sides are below 0 | hint: below 0. Refuse such a request
replace("if (", "if (!(request.length < 0 && request.width < 0 && request.height < 0) && (")
replace("request.height < 0) return", "request.height < 0)) return")
# %% 13.2 wrong: passes request and response by value | hint: and with both &
replace("& ", " ", times=2)
# %% 13.2 wrong: passes a lambda function without a capture | hint: Store the lambda function in a boost::function
replace("bool measure … }", "using Box = course_pkg::geometry;")
replace('advertiseService("box", measure)', """advertiseService<Box::Request, Box::Response>(
      "box", [](Box::Request& request, Box::Response& response) {
        response.area = request.width * request.length;
        response.volume = response.area * request.height;
        return request.length >= 0 && request.width >= 0 && request.height >= 0;
      })""")
# %% 13.2 wrong: stores the area as an int | hint: because an int stores only whole numbers
replace("response.area = request", "int area = request")
replace("request.width;", "request.width;\n  response.area = area;")
replace("volume = response.area", "volume = area")
# %% 13.2 wrong: omits the return at the end | hint: Write `return true;` or `return false;` at the end of every branch
replace("\n  return true;", "")
# %% 13.2 wrong: returns 0 instead of true | hint: The handler returned false for a valid request, so the client got an error
replace("true", "0")
# %% 13.2 wrong: does not store the ServiceServer object | hint: advertiseService returns an object, and the service
replace("ros::ServiceServer server = node", "node")
# %% 13.2 wrong: omits spin | hint: The program ends, so its service also ends
replace(";\n  ros::spin();", ";")
# %% 13.2 wrong: accepts negative sides | hint: below 0. Refuse such a request
replace("\n  if (request.length < 0 || request.width < 0 || request.height < 0) return false;", "")
# %% 13.2 wrong: omits a semicolon | hint: for a missing ; or bracket
replace("request.width;", "request.width")
# %% 13.2 wrong: misspells a field | hint: This object has no field or method high
replace("request.height < 0", "request.high < 0")
# %% 13.2 wrong: checks only two sides | hint: The server sent a response, but height was below 0
replace("0 || request.height < 0", "0")
# %% 13.2 wrong: checks only the area and the volume | hint: below 0. Refuse such a request
replace("\n  if (request.length < 0 || request.width < 0 || request.height < 0) return false;", "")
replace("true", "response.area >= 0 && response.volume >= 0")
# %% 13.2 wrong: checks only the volume | hint: below 0. Refuse such a request
replace("\n  if (request.length < 0 || request.width < 0 || request.height < 0) return false;", "")
replace("true", "response.volume >= 0")
# %% 13.2 wrong: converts the sides to int before the comparison | hint: a request in which a side is between -1 and 0
replace("request.length < 0 || request.width < 0 || request.height < 0", "int(request.length) < 0 || int(request.width) < 0 || int(request.height) < 0")
# %% 13.2 wrong: returns the area 0 if the height is 0 | hint: The height was 0, so the volume is 0, but the area is not 0
replace("  response.area =", "  if (request.height == 0) return true;\n  response.area =")
# %% 13.2 wrong: refuses a side of 0 | hint: A side was 0, but the handler refused the call
replace(" 0", "= 0", times=3)
# %% 13.2 wrong: stores the volume as an int | hint: because an int stores only whole numbers
replace("response.volume = response.area", "int volume = request.length * request.width")
replace("  return true;", "  response.volume = volume;\n  return true;")
# %% 13.2 wrong: forgets the area | hint: The area is 0
replace("response.area = request.length * request.width;\n  response.volume = response.area", "response.volume = request.length * request.width")
# %% 13.2 wrong: forgets the volume | hint: The volume is 0
replace("\n  response.volume = response.area * request.height;", "")
# %% 13.2 wrong: adds the height | hint: The volume is wrong
replace("response.area * request.height", "response.area + request.height")
# %% 13.2 wrong: exits if a side is below 0 | hint: The program has ended, or it does not respond
replace(") return false;", ") std::exit(1);")
# %% 13.2 wrong: uses a private service name | hint: The node does not offer a service with the right name
replace("NodeHandle node", "NodeHandle node(\"~\")")
# %% 13.2 wrong: omits ros::init | hint: The program crashed
replace("  ros::init(argc, argv, \"box_server\");\n", "")

# %% 13.3 right: uses a loop that ends with the first response
solution()
# %% 13.3 right: uses the functions of ros::service
replace('\n  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");', "")
replace("if (!client.waitForExistence(ros::Duration(2))) return … return 1;", """bool answered = false;
  if (ros::service::waitForService("box", 2000)) {
    for (int left = 3; left > 0 && !answered; left--) {
      answered = ros::service::call("box", box);
      if (!answered) ros::WallDuration(0.1).sleep();
    }
  }
  if (!answered) {
    std::cerr << "no volume" << std::endl;
    return 1;
  }
  std::cout << "volume: " << box.response.volume << std::endl;""")
# %% 13.3 right: prints each attempt
replace("\n  course_pkg … std::endl;", """
  course_pkg::geometry::Request request;
  course_pkg::geometry::Response response;
  request.length = std::stof(argv[1]);
  request.width = std::stof(argv[2]);
  request.height = std::stof(argv[3]);
  if (!ros::service::waitForService("box", ros::Duration(2.0))) {
    std::cout << "box did not come within 2 seconds" << std::endl;
    return 1;
  }
  int attempt = 1;
  do {
    if (client.call(request, response)) {
      std::cout << "Volume = " << response.volume << std::endl;""")
replace("\n    ros::WallDuration(0.2).sleep();\n  }", """
    ROS_INFO("attempt %d was refused", attempt);
    ros::Duration(0.05).sleep();
    attempt++;
  } while (attempt <= 3);
  std::cout << "no volume after 3 attempts" << std::endl;""")
# %% 13.3 wrong: does not wait for the service | hint: The program did not wait
replace(";\n  if (!client.waitForExistence(ros::Duration(2))) return 1;", ";")
# %% 13.3 wrong: waits for the service without a limit | hint: The program waits without a
replace("if (!client.waitForExistence(ros::Duration(2))) return 1;", "client.waitForExistence();")
# %% 13.3 wrong: ignores the return value of call() | hint: call() returned false, but the program printed an empty response
replace("if (client.call(box)) {", "client.call(box);\n    {")
# %% 13.3 wrong: checks the volume instead of the return value | hint: A response with the volume 0 is valid
replace("if (client.call(box)) {", "client.call(box);\n    if (box.response.volume > 0) {")
# %% 13.3 wrong: calls without a limit | hint: Count the calls, and stop after the third
replace("tries < 3; ++tries", ";")
# %% 13.3 wrong: counts its runs in a file | hint: The server refused the first two calls, but it responds to the third call
replace("#include <ros", "#include <fstream>\n#include <ros")
replace("  ros::NodeHandle", """  int run = 0;
  std::ifstream("runs") >> run;
  std::ofstream("runs") << ++run;
  ros::NodeHandle""")
replace("tries < 3", "tries < (run > 9 ? 3 : 1)")
# %% 13.3 wrong: calls four times | hint: calls, but it has to make 3
replace("tries < 3", "tries <= 3")
# %% 13.3 wrong: calls twice | hint: The server refused the first two calls, but it responds to the third call
replace("3;", "2;")
# %% 13.3 wrong: continues after the response | hint: The server sent a response, but the program called the server again
replace("\n      return 0;\n    }\n    ros::WallDuration(0.2).sleep();\n  }\n  return 1;", "\n    }\n  }\n  return 0;")
# %% 13.3 wrong: exits with status 0 after three failed calls | hint: No call got a response
replace("\n  return 1;", "\n  return 0;")
# %% 13.3 wrong: calculates the volume without the response | hint: The printed volume is not the volume that the server sent
replace("box.response.volume", "box.request.length * box.request.width * box.request.height")
# %% 13.3 wrong: prints the volume as a whole number | hint: The digits after the decimal point are missing in the printed volume
replace("      std::cout << box.response.volume", "      int volume = box.response.volume;\n      std::cout << volume")
# %% 13.3 wrong: calculates the volume if the server refuses | hint: but the program printed a volume that the server did not send
replace("if (client.call(box)) {", "if (!client.call(box)) box.response.volume = box.request.length * box.request.width * box.request.height;\n    {")
# %% 13.3 wrong: does not pause | hint: so the server probably refuses the next call, too
replace("\n    ros::WallDuration(0.2).sleep();", "")
# %% 13.3 wrong: waits for five seconds | hint: s, which is too long
replace("(2)", "(5)")
# %% 13.3 wrong: waits for three seconds | hint: s, which is too long
replace("(2)", "(3)")
# %% 13.3 wrong: waits for two milliseconds | hint: The program waited only a few milliseconds, because waitForService reads a plain number as
replace('\n  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");', "")
replace("client.waitForExistence(ros::Duration(2))", 'ros::service::waitForService("box", 2)')
replace("client.call(box)", 'ros::service::call("box", box)')
# %% 13.3 wrong: prints nothing | hint: Print box.response.volume to std::cout
replace("      std::cout << box.response.volume << std::endl;\n", "")
# %% 13.3 wrong: prints a volume after three failed calls | hint: The program printed a volume, although it got no response
replace("\n  return 1;", "\n  std::cout << box.response.volume << std::endl;\n  return 1;")
# %% 13.3 wrong: exits with status 0 if there is no server | hint: When the time is over, waitForExistence returns false
replace("(ros::Duration(2))) return 1", "(ros::Duration(2))) return 0")

# %% 13.4 right: uses an AsyncSpinner, and locks the count
solution()
# %% 13.4 right: uses a MultiThreadedSpinner, and locks after think()
replace("\n  std::lock_guard<std::mutex> lock(counting);", "")
replace("think();", "think();\n  std::unique_lock<std::mutex> lock(counting);")
replace("ros::AsyncSpinner … waitForShutdown();", "ros::MultiThreadedSpinner spinner(8);\n  spinner.spin();")
# %% 13.4 wrong: uses a lock, but only one thread | hint: ros::spin() executes only one callback at a time
replace("\n  ros::AsyncSpinner spinner(6);\n  spinner.start();", "")
replace("waitForShutdown()", "spin()")
# %% 13.4 wrong: uses several threads without a lock | hint: Two threads read the same number, and both threads add 1 to it
replace("\n  std::lock_guard<std::mutex> lock(counting);", "")
# %% 13.4 wrong: uses an atomic number | hint: Two threads can read the same number before one of them writes the
replace("include <mutex", "include <atomic")
replace("int served = 0;\nstd::mutex counting;", "std::atomic<int> served{0};")
replace("\n  std::lock_guard<std::mutex> lock(counting);", "")
# %% 13.4 wrong: creates the mutex in the function | hint: Each call creates its own mutex
replace("int served = 0;\nstd::mutex counting;", "int served = 0;")
replace("int count() {", "int count() {\n  std::mutex counting;")
# %% 13.4 wrong: holds the lock during think() | hint: The handler holds the lock during think()
replace("\n  std::lock_guard<std::mutex> lock(counting);", "")
replace("  think();", "  std::lock_guard<std::mutex> lock(counting);\n  think();")
# %% 13.4 wrong: starts only one thread | hint: The spinner has too few threads
replace("6", "1")
# %% 13.4 wrong: does not start the spinner | hint: The AsyncSpinner executes no callbacks, because it was not started
replace("\n  spinner.start();", "")
# %% 13.4 wrong: does not wait in main() | hint: The program ends, because main starts the spinner and then returns
replace("spinner.start();\n  ros::waitForShutdown();", "spinner.start();")
# %% 13.4 wrong: removes the pause from think() | hint: The functions think() and count() simulate long calculations, so do
replace("\n  ros::WallDuration(0.4).sleep();", "")
# %% 13.4 wrong: starts only three threads | hint: The spinner has too few threads
replace("6", "3")
# %% 13.4 wrong: shortens think(), and uses one thread | hint: The functions think() and count() simulate long
replace("int served = 0;\nstd::mutex counting;", "int served = 0;")
replace("0.4", "0.04")
replace("\n  std::lock_guard<std::mutex> lock(counting);", "")
replace("\n  ros::AsyncSpinner spinner(6);\n  spinner.start();", "")
replace("waitForShutdown()", "spin()")
# %% 13.4 wrong: replaces think() by its own pause | hint: The functions think() and count() simulate long
replace("  think();", "  if (served < 0) think();\n  ros::WallDuration(0.25).sleep();")
# %% 13.4 wrong: releases the lock between reading and writing | hint: The lock is not held between the read and the write, so two threads
replace("std::lock_guard<std::mutex> lock(counting);", "counting.lock();")
replace("int seen = served;", "int seen = served;\n  counting.unlock();")
replace("(0.05).sleep();", "(0.05).sleep();\n  counting.lock();")
replace("served = seen + 1;", "served = seen + 1;\n  counting.unlock();")
# %% 13.4 wrong: uses no spinner | hint: No spinner executes the callbacks
replace("\n  ros::AsyncSpinner spinner(6);\n  spinner.start();", "")
# %% 13.4 wrong: writes a zero before the number | hint: The field `message` has to contain only the number
replace("std::to_string(count())", "\"0\" + std::to_string(count())")
# %% 13.4 wrong: writes a text before the number | hint: The field `message` has to contain only the number
replace("std::to_string(count())", "\"number \" + std::to_string(count())")
