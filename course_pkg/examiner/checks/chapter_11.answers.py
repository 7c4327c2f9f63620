"""What students write in the exercises of chapter 11."""

# %% before
from course_pkg import join

node = join("chapter_11")

# %% 11.1 right: as in the chapter
%%writefile src/cpp_boxes/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(cpp_boxes)

find_package(catkin REQUIRED COMPONENTS roscpp course_pkg)
catkin_package()

include_directories(${catkin_INCLUDE_DIRS})
add_executable(box_server src/box_server.cpp)
target_link_libraries(box_server ${catkin_LIBRARIES})

# %% 11.1 right: with the headers for this program only, and in capitals
%%writefile src/cpp_boxes/CMakeLists.txt
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

# %% 11.1 wrong: the file without its folder | hint: Write its path from the package's own folder
%%writefile src/cpp_boxes/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(cpp_boxes)

find_package(catkin REQUIRED COMPONENTS roscpp course_pkg)
catkin_package()

include_directories(${catkin_INCLUDE_DIRS})
add_executable(box_server box_server.cpp)
target_link_libraries(box_server ${catkin_LIBRARIES})

# %% 11.1 wrong: linked before it is there | hint: add_executable comes first, and both have the same name
%%writefile src/cpp_boxes/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(cpp_boxes)

find_package(catkin REQUIRED COMPONENTS roscpp course_pkg)
catkin_package()

include_directories(${catkin_INCLUDE_DIRS})
target_link_libraries(box_server ${catkin_LIBRARIES})
add_executable(box_server src/box_server.cpp)

# %% 11.1 wrong: not linked | hint: Write target_link_libraries(PROGRAM ${catkin_LIBRARIES}) below add_executable
%%writefile src/cpp_boxes/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(cpp_boxes)

find_package(catkin REQUIRED COMPONENTS roscpp course_pkg)
catkin_package()

include_directories(${catkin_INCLUDE_DIRS})
add_executable(box_server src/box_server.cpp)

# %% 11.1 wrong: no headers | hint: write include_directories(${catkin_INCLUDE_DIRS}) above add_executable
%%writefile src/cpp_boxes/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(cpp_boxes)

find_package(catkin REQUIRED COMPONENTS roscpp course_pkg)
catkin_package()

add_executable(box_server src/box_server.cpp)
target_link_libraries(box_server ${catkin_LIBRARIES})

# %% 11.1 wrong: another name for the program | hint: The first word in add_executable is the name of the program
%%writefile src/cpp_boxes/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(cpp_boxes)

find_package(catkin REQUIRED COMPONENTS roscpp course_pkg)
catkin_package()

include_directories(${catkin_INCLUDE_DIRS})
add_executable(server src/box_server.cpp)
target_link_libraries(server ${catkin_LIBRARIES})

# %% 11.1 wrong: catkin_package last | hint: it stands above add_executable
%%writefile src/cpp_boxes/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(cpp_boxes)

find_package(catkin REQUIRED COMPONENTS roscpp course_pkg)
include_directories(${catkin_INCLUDE_DIRS})
add_executable(box_server src/box_server.cpp)
target_link_libraries(box_server ${catkin_LIBRARIES})
catkin_package()

# %% 11.1 wrong: catkin_package lost | hint: There is no catkin_package
%%writefile src/cpp_boxes/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(cpp_boxes)

find_package(catkin REQUIRED COMPONENTS roscpp course_pkg)
include_directories(${catkin_INCLUDE_DIRS})
add_executable(box_server src/box_server.cpp)
target_link_libraries(box_server ${catkin_LIBRARIES})

# %% 11.1 wrong: takes out what complains | hint: nothing is made of src/box_server.cpp
%%writefile src/cpp_boxes/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(cpp_boxes)

find_package(catkin REQUIRED COMPONENTS roscpp course_pkg)
catkin_package()

include_directories(${catkin_INCLUDE_DIRS})

# %% 11.1 wrong: roscpp not found | hint: roscpp is not among them
%%writefile src/cpp_boxes/CMakeLists.txt
cmake_minimum_required(VERSION 3.10)
project(cpp_boxes)

find_package(catkin REQUIRED COMPONENTS course_pkg)
catkin_package()

include_directories(${catkin_INCLUDE_DIRS})
add_executable(box_server src/box_server.cpp)
target_link_libraries(box_server ${catkin_LIBRARIES})

# %% 11.2 right: repaired where it was broken
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  if (request.length < 0 || request.width < 0 || request.height < 0) return false;
  response.area = request.length * request.width;
  response.volume = response.area * request.height;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.2 right: a lambda in the place of a function, and a spinner of its own
%%writefile src/cpp_boxes/src/box_server.cpp
#include <algorithm>
#include <course_pkg/geometry.h>
#include <ros/ros.h>

using Box = course_pkg::geometry;

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  boost::function<bool(Box::Request&, Box::Response&)> measure = [](Box::Request& req, Box::Response& res) {
    auto floor = double(req.length) * req.width;
    res.area = floor;
    res.volume = floor * req.height;
    return std::min({req.length, req.width, req.height}) >= 0;
  };
  auto server = node.advertiseService("box", measure);
  ros::AsyncSpinner spinner(2);
  spinner.start();
  ros::waitForShutdown();
  return 0;
}

# %% 11.2 wrong: both halves by value | hint: and each with its &
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request request, course_pkg::geometry::Response response) {
  if (request.length < 0 || request.width < 0 || request.height < 0) return false;
  response.area = request.length * request.width;
  response.volume = response.area * request.height;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.2 wrong: a whole number for the area | hint: an int holds whole numbers only. Take float
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  if (request.length < 0 || request.width < 0 || request.height < 0) return false;
  int area = request.length * request.width;
  response.area = area;
  response.volume = area * request.height;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.2 wrong: no return at the end | hint: Write return true or return false on every way
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  if (request.length < 0 || request.width < 0 || request.height < 0) return false;
  response.area = request.length * request.width;
  response.volume = response.area * request.height;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.2 wrong: false where all went well, as exit status 0 | hint: The handler returned false, which says: I could not
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  if (request.length < 0 || request.width < 0 || request.height < 0) return false;
  response.area = request.length * request.width;
  response.volume = response.area * request.height;
  return 0;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.2 wrong: what is advertised is not kept | hint: Keep it in a variable: ros::ServiceServer server
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  if (request.length < 0 || request.width < 0 || request.height < 0) return false;
  response.area = request.length * request.width;
  response.volume = response.area * request.height;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.2 wrong: nobody spins | hint: main came to its end, and the service with it
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  if (request.length < 0 || request.width < 0 || request.height < 0) return false;
  response.area = request.length * request.width;
  response.volume = response.area * request.height;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
}

# %% 11.2 wrong: refuses nothing | hint: Return false there, before measuring
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  response.area = request.length * request.width;
  response.volume = response.area * request.height;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.2 wrong: a semicolon lost | hint: for a missing ; or bracket
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  if (request.length < 0 || request.width < 0 || request.height < 0) return false;
  response.area = request.length * request.width
  response.volume = response.area * request.height;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.2 wrong: a field misspelt | hint: There is no field or method high
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  if (request.length < 0 || request.width < 0 || request.high < 0) return false;
  response.area = request.length * request.width;
  response.volume = response.area * request.height;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.2 wrong: looks at two sides | hint: It answered, and below 0: height
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  if (request.length < 0 || request.width < 0) return false;
  response.area = request.length * request.width;
  response.volume = response.area * request.height;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.2 wrong: looks at the volume | hint: Return false there, before measuring
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  response.area = request.length * request.width;
  response.volume = response.area * request.height;
  return response.volume >= 0;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.2 wrong: refuses 0 | hint: 0 is not below 0
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  if (request.length <= 0 || request.width <= 0 || request.height <= 0) return false;
  response.area = request.length * request.width;
  response.volume = response.area * request.height;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.2 wrong: a whole number for the volume | hint: The fraction is gone
%%writefile src/cpp_boxes/src/box_server.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

bool measure(course_pkg::geometry::Request& request, course_pkg::geometry::Response& response) {
  if (request.length < 0 || request.width < 0 || request.height < 0) return false;
  response.area = request.length * request.width;
  int volume = request.length * request.width * request.height;
  response.volume = volume;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "box_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("box", measure);
  ros::spin();
}

# %% 11.3 right: a loop that is left with the answer
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  if (!client.waitForExistence(ros::Duration(2))) return 1;
  for (int tries = 0; tries < 3; ++tries) {
    if (client.call(box)) {
      std::cout << box.response.volume << std::endl;
      return 0;
    }
    ros::WallDuration(0.2).sleep();
  }
  return 1;
}

# %% 11.3 right: the bare way, with the answer kept
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  bool answered = false;
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
  std::cout << "volume: " << box.response.volume << std::endl;
}

# %% 11.3 right: tells of its tries
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
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
      std::cout << "Volume = " << response.volume << std::endl;
      return 0;
    }
    ROS_INFO("attempt %d was refused", attempt);
    ros::Duration(0.05).sleep();
    attempt++;
  } while (attempt <= 3);
  std::cout << "no volume after 3 attempts" << std::endl;
  return 1;
}

# %% 11.3 wrong: does not wait | hint: It did not wait. client.waitForExistence
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  for (int tries = 0; tries < 3; ++tries) {
    if (client.call(box)) {
      std::cout << box.response.volume << std::endl;
      return 0;
    }
    ros::WallDuration(0.2).sleep();
  }
  return 1;
}

# %% 11.3 wrong: waits for ever | hint: Give the waiting a limit: waitForExistence(ros::Duration(2))
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  client.waitForExistence();
  for (int tries = 0; tries < 3; ++tries) {
    if (client.call(box)) {
      std::cout << box.response.volume << std::endl;
      return 0;
    }
    ros::WallDuration(0.2).sleep();
  }
  return 1;
}

# %% 11.3 wrong: believes whatever call says | hint: Look at what call returns
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  if (!client.waitForExistence(ros::Duration(2))) return 1;
  for (int tries = 0; tries < 3; ++tries) {
    client.call(box);
    {
      std::cout << box.response.volume << std::endl;
      return 0;
    }
    ros::WallDuration(0.2).sleep();
  }
  return 1;
}

# %% 11.3 wrong: asks for ever | hint: Count the calls, and stop after the third
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  if (!client.waitForExistence(ros::Duration(2))) return 1;
  for (int tries = 0; ;) {
    if (client.call(box)) {
      std::cout << box.response.volume << std::endl;
      return 0;
    }
    ros::WallDuration(0.2).sleep();
  }
  return 1;
}

# %% 11.3 wrong: asks once, and three times more | hint: It asked 4 times. The first call is one of the three
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  if (!client.waitForExistence(ros::Duration(2))) return 1;
  for (int tries = 0; tries <= 3; ++tries) {
    if (client.call(box)) {
      std::cout << box.response.volume << std::endl;
      return 0;
    }
    ros::WallDuration(0.2).sleep();
  }
  return 1;
}

# %% 11.3 wrong: asks once more | hint: It gave up too early
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  if (!client.waitForExistence(ros::Duration(2))) return 1;
  for (int tries = 0; tries < 2; ++tries) {
    if (client.call(box)) {
      std::cout << box.response.volume << std::endl;
      return 0;
    }
    ros::WallDuration(0.2).sleep();
  }
  return 1;
}

# %% 11.3 wrong: goes on after the answer | hint: leave the loop as soon as call returns true
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  if (!client.waitForExistence(ros::Duration(2))) return 1;
  for (int tries = 0; tries < 3; ++tries) {
    if (client.call(box)) {
      std::cout << box.response.volume << std::endl;
    }
  }
  return 0;
}

# %% 11.3 wrong: a success in any case | hint: Return 1 then, so that a script can tell
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  if (!client.waitForExistence(ros::Duration(2))) return 1;
  for (int tries = 0; tries < 3; ++tries) {
    if (client.call(box)) {
      std::cout << box.response.volume << std::endl;
      return 0;
    }
    ros::WallDuration(0.2).sleep();
  }
  return 0;
}

# %% 11.3 wrong: computes it itself | hint: print box.response.volume, and compute nothing
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  if (!client.waitForExistence(ros::Duration(2))) return 1;
  for (int tries = 0; tries < 3; ++tries) {
    if (client.call(box)) {
      std::cout << box.request.length * box.request.width * box.request.height << std::endl;
      return 0;
    }
    ros::WallDuration(0.2).sleep();
  }
  return 1;
}

# %% 11.3 wrong: no pause | hint: Who was refused now is refused a millisecond later
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  if (!client.waitForExistence(ros::Duration(2))) return 1;
  for (int tries = 0; tries < 3; ++tries) {
    if (client.call(box)) {
      std::cout << box.response.volume << std::endl;
      return 0;
    }
  }
  return 1;
}

# %% 11.3 wrong: five seconds | hint: It waited too long
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  if (!client.waitForExistence(ros::Duration(5))) return 1;
  for (int tries = 0; tries < 3; ++tries) {
    if (client.call(box)) {
      std::cout << box.response.volume << std::endl;
      return 0;
    }
    ros::WallDuration(0.2).sleep();
  }
  return 1;
}

# %% 11.3 wrong: two milliseconds | hint: in ros::service::waitForService means milliseconds
%%writefile src/cpp_boxes/src/patient_client.cpp
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  if (!ros::service::waitForService("box", 2)) return 1;
  for (int tries = 0; tries < 3; ++tries) {
    if (ros::service::call("box", box)) {
      std::cout << box.response.volume << std::endl;
      return 0;
    }
    ros::WallDuration(0.2).sleep();
  }
  return 1;
}

# %% 11.4 right: an AsyncSpinner, and a lock where it counts
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;
std::mutex counting;

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.4).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  std::lock_guard<std::mutex> lock(counting);
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::AsyncSpinner spinner(6);
  spinner.start();
  ros::waitForShutdown();
}

# %% 11.4 right: a MultiThreadedSpinner, and the lock in the handler after thinking
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;
std::mutex counting;

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.4).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  std::unique_lock<std::mutex> lock(counting);
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::MultiThreadedSpinner spinner(8);
  spinner.spin();
}

# %% 11.4 wrong: a lock, and still one thread | hint: ros::spin() hands out one callback after the other
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;
std::mutex counting;

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.4).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  std::lock_guard<std::mutex> lock(counting);
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::spin();
}

# %% 11.4 wrong: more threads, and no lock | hint: Hold a mutex from the reading to the writing: std::lock_guard
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;
std::mutex counting;

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.4).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::AsyncSpinner spinner(6);
  spinner.start();
  ros::waitForShutdown();
}

# %% 11.4 wrong: an atomic number | hint: Each access is safe, and the three lines are not
%%writefile src/cpp_boxes/src/number_server.cpp
#include <atomic>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

std::atomic<int> served{0};

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.4).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::AsyncSpinner spinner(6);
  spinner.start();
  ros::waitForShutdown();
}

# %% 11.4 wrong: a mutex in the function | hint: Each call makes a mutex of its own
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.4).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  std::mutex counting;
  std::lock_guard<std::mutex> lock(counting);
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::AsyncSpinner spinner(6);
  spinner.start();
  ros::waitForShutdown();
}

# %% 11.4 wrong: locked while it thinks | hint: Whoever holds the lock while it thinks
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;
std::mutex counting;

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.4).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  std::lock_guard<std::mutex> lock(counting);
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::AsyncSpinner spinner(6);
  spinner.start();
  ros::waitForShutdown();
}

# %% 11.4 wrong: one thread asked for | hint: each takes a thread: write how many
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;
std::mutex counting;

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.4).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  std::lock_guard<std::mutex> lock(counting);
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  ros::waitForShutdown();
}

# %% 11.4 wrong: never started | hint: does nothing before its start()
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;
std::mutex counting;

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.4).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  std::lock_guard<std::mutex> lock(counting);
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::AsyncSpinner spinner(6);
  ros::waitForShutdown();
}

# %% 11.4 wrong: main does not wait | hint: main has to wait, by ros::waitForShutdown()
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;
std::mutex counting;

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.4).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  std::lock_guard<std::mutex> lock(counting);
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::AsyncSpinner spinner(6);
  spinner.start();
}

# %% 11.4 wrong: thinks no more | hint: Leave think() and count() as slow as they are
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;
std::mutex counting;

// Takes its time, and touches nothing that others need.
void think() {
}

// Reads, takes a moment, and writes.
int count() {
  std::lock_guard<std::mutex> lock(counting);
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::AsyncSpinner spinner(6);
  spinner.start();
  ros::waitForShutdown();
}

# %% 11.4 wrong: three threads | hint: write how many
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;
std::mutex counting;

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.4).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  std::lock_guard<std::mutex> lock(counting);
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::AsyncSpinner spinner(3);
  spinner.start();
  ros::waitForShutdown();
}

# %% 11.4 wrong: thinks for less, on one thread | hint: Leave think() and count() as slow as they are
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.04).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  int seen = served;
  ros::WallDuration(0.05).sleep();
  served = seen + 1;
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::spin();
}

# %% 11.4 wrong: lets go in between | hint: nobody holds it between the reading and the writing
%%writefile src/cpp_boxes/src/number_server.cpp
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;
std::mutex counting;

// Takes its time, and touches nothing that others need.
void think() {
  ros::WallDuration(0.4).sleep();
}

// Reads, takes a moment, and writes.
int count() {
  counting.lock();
  int seen = served;
  counting.unlock();
  ros::WallDuration(0.05).sleep();
  counting.lock();
  served = seen + 1;
  counting.unlock();
  return served;
}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::AsyncSpinner spinner(6);
  spinner.start();
  ros::waitForShutdown();
}
