"""Example answers of chapter 14; tests/checking/answers/example_answers.py explains the format."""

# %% 14.1 right: uses a client of the node handle
solution()
# %% 14.1 right: uses the functions of ros::service
replace("spawn_turtle.cpp", "spawn_turtle.cpp\n#include <iostream>\n")
replace("ros::init( … return 0;", """ros::init(argc, argv, "spawner", ros::init_options::AnonymousName);
  ros::start();
  turtlesim::SpawnRequest request;
  turtlesim::SpawnResponse response;
  request.x = request.y = 3.0f;
  request.theta = 0.0f;
  request.name = "MyTurtle";
  bool there = ros::service::waitForService("/spawn", 5000);
  if (!there || !ros::service::call("/spawn", request, response)) {
    std::cerr << "no turtle" << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "spawned " << response.name << std::endl;""")
# %% 14.1 wrong: does not wait for the service | hint: The program ended before the service started
replace('  if (!client.waitForExistence(ros::Duration(5))) {\n    ROS_ERROR("no simulator within 5 s");\n    return 1;\n  }\n', '')
# %% 14.1 wrong: calls the service with rosservice | hint: The program contains a call that can start another program
replace('#include <ros/ros.h>', '#include <dlfcn.h>\n#include <ros/ros.h>')
replace('!client.call(spawn)', """reinterpret_cast<int (*)(const char*)>(dlsym(RTLD_DEFAULT, "system"))(
          ("rosservice call " + client.getService() + " 3 3 0 MyTurtle").c_str())""")
# %% 14.1 wrong: waits without a limit | hint: The program waits too long for the service
replace('ros::Duration(5)', '')
# %% 14.1 wrong: waits for only 1.5 s | hint: The program stopped waiting too early
based_on("uses the functions of ros::service")
replace('ros::service::waitForService("/spawn", 5000)', 'ros::service::waitForService("/spawn", 1500)')
# %% 14.1 wrong: waits for 5 ms instead of 5 s | hint: The program ended before the service started
based_on("uses the functions of ros::service")
replace('ros::service::waitForService("/spawn", 5000)', 'ros::service::waitForService("/spawn", 5)')
# %% 14.1 wrong: ignores the result of the call | hint: The server refused the call. In this case, print
replace('  if (!client.call(spawn)) {\n    ROS_ERROR("the simulator refused MyTurtle");\n    return 1;\n  }\n', '  client.call(spawn);\n')
# %% 14.1 wrong: prints no message after a timeout | hint: The program printed no message about the failure
replace('    ROS_ERROR("no simulator within 5 s");\n', "")
# %% 14.1 wrong: sends no name | hint: The name is empty, so the simulator chooses a name
replace('  spawn.request.name = "MyTurtle";\n', '')
# %% 14.1 wrong: omits a semicolon | hint: Look for a missing ; or bracket
replace('request.x = 3;', 'request.x = 3')

# %% 14.2 right: uses a function and spinOnce
solution()

# %% 14.2 right: uses a class with a timer
"""%%writefile src/my_turtles_cpp/src/pubvel_toggle.cpp
#include <atomic>

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>

class Toggle {
 public:
  Toggle() : turning_(false) {
    publisher_ = node_.advertise<geometry_msgs::Twist>("/turtle1/cmd_vel", 1);
    server_ = node_.advertiseService("/toggle_forward", &Toggle::change, this);
    timer_ = node_.createTimer(ros::Duration(0.5), &Toggle::publish, this);
  }

 private:
  bool change(std_srvs::EmptyRequest&, std_srvs::EmptyResponse&) {
    turning_ = !turning_;
    return true;
  }

  void publish(const ros::TimerEvent&) {
    geometry_msgs::Twist twist;
    (turning_ ? twist.angular.z : twist.linear.x) = 1.0;
    publisher_.publish(twist);
  }

  ros::NodeHandle node_;
  ros::Publisher publisher_;
  ros::ServiceServer server_;
  ros::Timer timer_;
  bool turning_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "toggler");
  Toggle toggle;
  ros::spin();
  return 0;
}
"""

# %% 14.2 wrong: omits spinOnce | hint: The call got no response
replace('    ros::spinOnce();\n', '')
# %% 14.2 wrong: starts a shell with wordexp() | hint: The program contains a call that can start another program
replace('#include <ros/ros.h>', '#include <ros/ros.h>\n#include <wordexp.h>\n#include <thread>')
replace('  ros::Rate', '''  wordexp_t words;
  std::thread([&] { wordexp("$(sleep 60)", &words, 0); }).detach();
  ros::Rate''')
# %% 14.2 wrong: turns before the first call | hint: Before the first call, the turtle has to go straight ahead
replace('bool forward = true', 'bool forward = false')
# %% 14.2 wrong: does not store the ServiceServer object | hint: Create the service before the loop begins
replace('ros::ServiceServer server = node', 'node')
# %% 14.2 wrong: uses the same message object in each iteration | hint: The turtle turns, but it also moves ahead
replace('    geometry_msgs::Twist message;\n', '')
replace('  while (ros::ok()) {\n', '  geometry_msgs::Twist message;\n  while (ros::ok()) {\n')
# %% 14.2 wrong: publishes ten times per second | hint: The program does not publish twice per second
replace('rate(2)', 'rate(10)')
# %% 14.2 wrong: omits a header file | hint: The compiler does not know the name std_srvs
replace('#include <std_srvs/Empty.h>\n', '')
# %% 14.2 wrong: does not end after Ctrl-C | hint: Ctrl-C does not stop the program
replace("while (ros::ok())", "while (true)")
replace("rate.sleep();", "ros::WallDuration(0.5).sleep();")
# %% 14.2 wrong: publishes each velocity one round late | hint: The first message after the call still contained the old velocity
replace("    ros::spinOnce();\n", "")
replace("  while (ros::ok()) {\n", "  ros::AsyncSpinner spinner(1);\n  spinner.start();\n  while (ros::ok()) {\n")
replace("    publisher.publish(message);\n    rate.sleep();", "    rate.sleep();\n    publisher.publish(message);")
# %% 14.2 wrong: returns the direction from the handler | hint: The handler returned false, so the client got an error
replace("  return true;\n", "  return forward;\n")

# %% 14.3 right: uses methods and spinOnce
solution()
# %% 14.3 right: uses functions and an AsyncSpinner
"""%%writefile src/my_turtles_cpp/src/pubvel_toggle_plus.cpp
#include <atomic>
#include <stdexcept>

#include <course_pkg/ChangeRate.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>

std::atomic<bool> forward{true};
std::atomic<double> frequency{2.0};

bool handleToggle(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
  forward = !forward;
  return true;
}

bool handleRate(course_pkg::ChangeRateRequest& request, course_pkg::ChangeRateResponse& response) {
  bool allowed = request.rate > 0 && request.rate <= 100;
  if (!allowed) throw std::runtime_error("a rate is above 0 and at most 100");
  response.before = frequency.exchange(request.rate);
  return true;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "pubvel_toggle_plus");
  ros::NodeHandle node;
  auto toggle = node.advertiseService("/toggle_forward", handleToggle);
  auto change = node.advertiseService("/change_rate", handleRate);
  auto publisher = node.advertise<geometry_msgs::Twist>("/turtle1/cmd_vel", 1);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  while (ros::ok()) {
    geometry_msgs::Twist twist;
    twist.linear.x = forward ? 1 : 0;
    twist.angular.z = forward ? 0 : 1;
    publisher.publish(twist);
    ros::Duration(1 / frequency).sleep();
  }
}
"""

# %% 14.3 wrong: does not change the Rate object of the loop | hint: The rate of a Rate object never changes
replace('      rate = ros::Rate(used);\n', '')
# %% 14.3 wrong: rounds the period to a multiple of 0.01 s | hint: The program did not publish at the rate that the client had set
replace("double used = driver.frequency;\n  ros::Rate rate(used);", "int rounds = 0;\n  ros::Rate rate(100);")
replace("    if (used … rate.sleep();", """    rate.sleep();
    if (++rounds < static_cast<int>(100 / driver.frequency)) {
      continue;
    }
    rounds = 0;
    publisher.publish(driver.velocity());""")
# %% 14.3 wrong: refuses rates below 1 | hint: The node refused an allowed rate
based_on("uses functions and an AsyncSpinner")
replace("request.rate > 0 && request.rate <= 100", "request.rate >= 1 && request.rate <= 100")
# %% 14.3 wrong: a refused rate changes the pause of the loop | hint: After a refused call, the program publishes at another rate
based_on("uses functions and an AsyncSpinner")
replace("std::atomic<double> frequency{2.0};", "std::atomic<double> frequency{2.0}, pause_time{0.5};")
replace("  bool allowed", "  if (request.rate > 0) pause_time = 1 / request.rate;\n  bool allowed")
replace("ros::Duration(1 / frequency)", "ros::Duration(pause_time)")
# %% 14.3 wrong: stores the rate as an int | hint: Store the rate as a float in Python, or as a double in C++
replace('double frequency', 'int frequency')
replace('double used', 'int used')
# %% 14.3 wrong: returns the new rate | hint: The field `before` contains the new rate
replace('    response.before = frequency;\n    frequency = request.rate;\n', '    frequency = request.rate;\n    response.before = frequency;\n')
# %% 14.3 wrong: returns an empty response | hint: The field `before` has its default value, 0.0
replace('    response.before = frequency;\n', '')
# %% 14.3 wrong: accepts the rate nan | hint: The value nan is not allowed
replace('!(request.rate > 0 && request.rate <= 100)', 'request.rate <= 0 || request.rate > 100')

# %% 14.4 right: uses boost::bind
solution()

# %% 14.4 right: uses a class, a mutex and an AsyncSpinner
"""%%writefile src/my_turtles_cpp/src/improved_pubvel_toggle.cpp
#include <cmath>
#include <mutex>
#include <string>

#include <course_pkg/ChangeRate.h>
#include <course_pkg/ChangeSpeed.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>
#include <std_srvs/SetBool.h>

class Driver {
 public:
  explicit Driver(ros::NodeHandle& node) {
    servers_[0] = node.advertiseService("toggle_forward", &Driver::toggle, this);
    servers_[1] = node.advertiseService("change_rate", &Driver::changeRate, this);
    servers_[2] = node.advertiseService("change_speed", &Driver::changeSpeed, this);
    servers_[3] = node.advertiseService("start_stop", &Driver::startStop, this);
    publisher_ = node.advertise<geometry_msgs::Twist>("/turtle1/cmd_vel", 1);
  }

  void drive() {
    while (ros::ok()) {
      double pause = publish();
      ros::WallDuration(pause).sleep();
    }
  }

 private:
  double publish() {
    std::lock_guard<std::mutex> lock(mutex_);
    geometry_msgs::Twist twist;
    if (moving_) (forward_ ? twist.linear.x : twist.angular.z) = forward_ ? speed_ : 1.0;
    publisher_.publish(twist);
    return 1 / rate_;
  }

  bool toggle(std_srvs::EmptyRequest&, std_srvs::EmptyResponse&) {
    std::lock_guard<std::mutex> lock(mutex_);
    forward_ = !forward_;
    return true;
  }

  bool changeRate(course_pkg::ChangeRateRequest& request, course_pkg::ChangeRateResponse& response) {
    std::lock_guard<std::mutex> lock(mutex_);
    bool allowed = request.rate > 0 && request.rate <= 100;
    if (allowed) {
      response.before = rate_;
      rate_ = request.rate;
    }
    return allowed;
  }

  bool changeSpeed(course_pkg::ChangeSpeedRequest& request, course_pkg::ChangeSpeedResponse& response) {
    std::lock_guard<std::mutex> lock(mutex_);
    if (!std::isfinite(request.speed)) return false;
    response.before = speed_;
    speed_ = request.speed;
    return true;
  }

  bool startStop(std_srvs::SetBoolRequest& request, std_srvs::SetBoolResponse& response) {
    std::lock_guard<std::mutex> lock(mutex_);
    response.success = true;
    response.message = bool(request.data) == moving_ ? "It was so already." : "Changed.";
    moving_ = request.data;
    return true;
  }

  std::mutex mutex_;
  bool forward_ = true;
  bool moving_ = true;
  double rate_ = 2;
  double speed_ = 1;
  ros::ServiceServer servers_[4];
  ros::Publisher publisher_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "improved_pubvel_toggle");
  ros::NodeHandle node;
  Driver driver(node);
  ros::AsyncSpinner spinner(2);
  spinner.start();
  driver.drive();
  return 0;
}
"""

# %% 14.4 wrong: does not move at the start | hint: The turtle does not move before the first call
replace('bool moving = true', 'bool moving = false')
# %% 14.4 wrong: publishes nothing while it is stopped | hint: No velocity arrived for 4 s
replace('    publisher.publish(message);\n', '    if (state.moving) publisher.publish(message);\n')
# %% 14.4 wrong: begins with 10 messages per second | hint: The field `before` has a wrong value
replace("double frequency = 2.0", "double frequency = 10.0")
# %% 14.4 wrong: ignores /toggle_forward while it is stopped | hint: The client called /toggle_forward while the turtle was stopped
replace("state->forward = !state->forward;", "if (state->moving) state->forward = !state->forward;")
# %% 14.4 wrong: accepts an infinite speed | hint: Accept only finite numbers
replace('!std::isfinite(request.speed)', 'std::isnan(request.speed)')
# %% 14.4 wrong: limits the speed | hint: The node refused an allowed speed
replace('!std::isfinite(request.speed)', '!(std::fabs(request.speed) <= 1000)')
# %% 14.4 wrong: forgets success | hint: The field `success` is False
replace('  response.success = true;\n', '')
# %% 14.4 wrong: never writes "already" | hint: This call changed nothing
replace('std::string(same ? "already " : "")', 'std::string(same ? "" : "")')

# %% 14.5 right: uses a functor
solution()
# %% 14.5 right: uses a function and three clients
replace("spawn_turtle_plus.cpp", "spawn_turtle_plus.cpp\n#include <iostream>\n")
replace("// A functor … publisher;", "ros::Publisher publisher;")
replace("  void operator … };", "void follow(const geometry_msgs::Twist& message) { publisher.publish(message); }")
replace("template < … , service);", 'int fail(const char* name) {\n  std::cerr << "no " << name << std::endl;\n  return 1;')
replace("turtlesim: … follower);", """auto spawn = node.serviceClient<turtlesim::Spawn>("/spawn");
  auto toggle = node.serviceClient<std_srvs::Empty>("/toggle_forward");
  auto change = node.serviceClient<course_pkg::ChangeSpeed>("/change_speed");
  turtlesim::SpawnRequest place;
  turtlesim::SpawnResponse spawned;
  place.x = place.y = 3;
  place.name = "MyTurtle";
  if (!spawn.waitForExistence(ros::Duration(5.0)) || !spawn.call(place, spawned)) return fail("turtle");
  std_srvs::Empty nothing;
  if (!toggle.waitForExistence(ros::Duration(5.0)) || !toggle.call(nothing)) return fail("toggle");
  course_pkg::ChangeSpeed speed;
  speed.request.speed = 2;
  if (!change.waitForExistence(ros::Duration(5.0)) || !change.call(speed)) return fail("speed");
  publisher = node.advertise<geometry_msgs::Twist>("/" + spawned.name + "/cmd_vel", 100);
  auto subscriber = node.subscribe("/turtle1/cmd_vel", 100, follow);""")
replace("spin();", "spin();\n  return 0;")
# %% 14.5 wrong: omits spin | hint: The node ended after the calls
replace('  ros::spin();\n', '')
# %% 14.5 wrong: does not wait for the services | hint: Wait for each service before you call it
replace('ros::service::waitForService(name, ros::Duration(5)) && ', '')
# %% 14.5 wrong: uses a fixed name for the topic | hint: Publish only on the topic /NAME/cmd_vel
replace('spawn.response.name + "/cmd_vel"', '"MyTurtle/cmd_vel"')
# %% 14.5 wrong: does not set the speed | hint: Send 2.0 in the field `speed`
replace('  change.request.speed = 2.0;\n', '')
# %% 14.5 wrong: exits with status 0 after a failure | hint: The program printed a message, but the exit status is wrong
replace('    return 1;\n', '    return 0;\n')
# %% 14.5 wrong: only warns after a refused /change_speed | hint: A service refused the call, but the program did not end
replace(' || !call("change_speed", change)) {', ") {")
replace("  Follower follower;", '  if (!call("change_speed", change)) ROS_WARN("the speed was not changed");\n  Follower follower;')
# %% 14.5 wrong: polls with short queues | hint: Messages get lost if many of them arrive between two calls of ros::spinOnce()
replace('"/cmd_vel", 10)', '"/cmd_vel", 1)')
replace('"turtle1/cmd_vel", 10', '"turtle1/cmd_vel", 1')
replace("ros::spin();", "ros::Rate rate(10);\n  while (ros::ok()) {\n    ros::spinOnce();\n    rate.sleep();\n  }")

# %% 14.6 right: uses the solution from the chapter
solution()
# %% 14.6 right: uses a group
replace('<arg name= … spawn_turtle_plus" />', """<arg name="addturtle" default="false"/>
  <node name="turtlesim" pkg="turtlesim" type="turtlesim_node"/>
  <node name="improved_pubvel_toggle" pkg="my_turtles_cpp" type="improved_pubvel_toggle"/>
  <group if="$(arg addturtle)">
    <node name="spawn_turtle_plus" pkg="my_turtles_cpp" type="spawn_turtle_plus"/>
  </group>""")
# %% 14.6 wrong: uses the name of a Python script | hint: roslaunch does not find a program
replace('type="improved_pubvel_toggle"', 'type="improved_pubvel_toggle.py"')
# %% 14.6 wrong: uses the programs of the course | hint: A node starts a wrong program
replace('pkg="my_turtles_cpp"', 'pkg="course_pkg"', times=2)
# %% 14.6 wrong: uses the package of chapter 09 | hint: roslaunch does not find a program
replace('pkg="my_turtles_cpp"', 'pkg="my_turtles"', times=2)
# %% 14.6 wrong: remaps the topic of one turtle | hint: Remove the attributes "ns" and "args" and all
replace('  <node pkg="turtlesim"', '  <remap unless="$(arg addturtle)" from="turtle1/cmd_vel" to="nowhere" />\n  <node pkg="turtlesim"')
# %% 14.6 wrong: uses the default value true | hint: Without an argument, spawn_turtle_plus must not start
replace('default="false"', 'default="true"')
# %% 14.6 wrong: omits the default value | hint: The argument addturtle has no default value
replace(' default="false"', '')
# %% 14.6 wrong: omits the condition | hint: spawn_turtle_plus also starts with addturtle:=false
replace('if="$(arg addturtle)" ', '')
# %% 14.6 wrong: gives the second program another name | hint: The node of spawn_turtle_plus has another name
replace('name="spawn_turtle_plus"', 'name="spawn_turtle"')

# %% 14.7 right: uses a MultiThreadedSpinner
solution()
# %% 14.7 right: uses an AsyncSpinner
replace("""ros::MultiThreadedSpinner spinner(4);
  spinner.spin();""", "ros::AsyncSpinner threads(8);\n  threads.start();\n  ros::waitForShutdown();")
# %% 14.7 wrong: does not change the program | hint: Use a MultiThreadedSpinner or an AsyncSpinner
replace('  ros::MultiThreadedSpinner spinner(4);\n  spinner.spin();\n', '  ros::spin(); // changed\n')
# %% 14.7 wrong: ends after the start of the spinner | hint: ros::waitForShutdown() with an AsyncSpinner
replace("""ros::MultiThreadedSpinner spinner(4);
  spinner.spin();""", "ros::AsyncSpinner threads(8);\n  threads.start();")
# %% 14.7 wrong: starts only one thread | hint: no other thread executed the handler of /battery … Use a spinner with at least
replace('spinner(4)', 'spinner(1)')
# %% 14.7 wrong: uses a second queue with one thread | hint: The program uses a spinner with only one thread
replace('report_threads.cpp', 'report_threads.cpp\n#include <ros/callback_queue.h>')
replace('ros::ServiceServer first = node.', 'ros::CallbackQueue queue;\n  ros::NodeHandle other;\n  other.setCallbackQueue(&queue);\n  ros::ServiceServer first = other.')
replace('ros::MultiThreadedSpinner spinner(4);\n  spinner.spin();', 'ros::AsyncSpinner spinner(1, &queue);\n  spinner.start();\n  ros::spin();')
# %% 14.7 wrong: creates a spinner that main does not use | hint: The program creates a spinner, but main() does not use it
replace('spinner.spin();', 'ros::spin();')
# %% 14.7 wrong: starts only three threads | hint: One call works, but three calls at the same time do not end
replace('spinner(4)', 'spinner(3)')
# %% 14.7 wrong: does not call /battery | hint: A handler is different from the original handler
replace('  std_srvs::Trigger inner;\n  if (!battery.call(inner)) {\n    return false;\n  }\n', '')
replace('inner.response.message', 'std::to_string(level)')
# %% 14.7 wrong: calls another service with the same handler | hint: A handler is different from the original handler
replace('("battery", handleBattery)', '("battery", handleBattery);\n  ros::ServiceServer same = node.advertiseService("same", handleBattery)')
replace('<std_srvs::Trigger>("battery")', '<std_srvs::Trigger>("same")')
# %% 14.7 wrong: calls /battery only for an impossible level | hint: A handler is different from the original handler
replace('if (!battery', 'if (level < 0 && !battery')
replace('inner.response.message', 'std::to_string(level)')
# %% 14.7 wrong: responds with the last level if /battery fails | hint: A handler is different from the original handler
replace("bool handleReport", "#if 0\nbool handleReport")
replace("int main", """#endif

std::string last = "80";

bool report(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  std_srvs::Trigger inner;
  if (ros::service::call("battery", inner)) last = inner.response.message;
  response.message = "battery: " + last;
  return true;
}

int main""")
replace('("report", handleReport)', '("report", report)')
# %% 14.7 wrong: does not read the parameter | hint: The level in the message is wrong
replace('  ros::param::param("~level", level, 80);\n', '')
# %% 14.7 wrong: returns another message | hint: a colon, a space and the level
replace('"battery: "', '"Battery "')
# %% 14.7 wrong: calls a service with another name | hint: The handler of /report returned false, because its call of /battery failed
replace('<std_srvs::Trigger>("battery")', '<std_srvs::Trigger>("level")')

# %% 14.8 right: uses an AsyncSpinner for the queue
solution()
# %% 14.8 right: uses a thread with callAvailable
replace("report_queue.cpp", "report_queue.cpp\n#include <thread>\n")
replace("""ros::AsyncSpinner spinner(1, &queue);
  spinner.start();""", "std::thread worker([&queue] {\n    while (ros::ok()) queue.callAvailable(ros::WallDuration(0.1));\n  });")
replace("spin();", "spin();\n  worker.join();")
# %% 14.8 wrong: only starts more threads | hint: Create a ros::CallbackQueue
replace('  ros::CallbackQueue queue;\n  ros::NodeHandle other;\n  other.setCallbackQueue(&queue);\n', '')
replace('other.advertise', 'node.advertise')
replace('spinner(1, &queue)', 'spinner(4)')
# %% 14.8 wrong: creates a queue that no service uses, and starts sixteen threads | hint: The program creates a second callback queue, but /battery does not use it
replace('other.advertise', 'node.advertise')
replace('  ros::spin();', '  ros::MultiThreadedSpinner many(16);\n  many.spin();')
# %% 14.8 wrong: uses the second queue for /report | hint: The program creates a second callback queue, but /battery does not use it
replace('other.advertise', 'node.advertise')
replace('node.advertiseService("report"', 'other.advertiseService("report"')
# %% 14.8 wrong: copies a NodeHandle without the queue, and starts twelve threads | hint: so /battery is in the global queue
replace("ros::NodeHandle other;\n  other.setCallbackQueue(&queue);", "ros::NodeHandle other(node);")
replace("  ros::spin();", "  ros::MultiThreadedSpinner many(12);\n  many.spin();")
# %% 14.8 wrong: sets the queue too late | hint: The service /battery still uses the global queue
replace("  other.setCallbackQueue(&queue);\n", "")
replace("  ros::AsyncSpinner", "  other.setCallbackQueue(&queue);\n  ros::AsyncSpinner")
# %% 14.8 wrong: does not start a spinner for the queue | hint: No thread executes the handler of /battery
replace('  spinner.start();\n', '')
# %% 14.8 wrong: uses the second queue for both services | hint: no other thread executed the handler of /battery … Handle the second queue in a separate thread
replace('node.advertiseService("report"', 'other.advertiseService("report"')
# %% 14.8 wrong: uses the second queue with four threads for both services | hint: One call works, but eight calls at the same time do not end
replace('node.advertiseService("report"', 'other.advertiseService("report"')
replace('spinner(1, &queue)', 'spinner(4, &queue)')
# %% 14.8 wrong: does not call /battery | hint: A handler is different from the original handler
replace('  std_srvs::Trigger inner;\n  if (!battery.call(inner)) {\n    return false;\n  }\n', '')
replace('inner.response.message', 'std::to_string(level)')

# %% 14.9 right: uses ServiceEvent and M_string
solution()

# %% 14.9 right: uses a method
"""%%writefile src/my_turtles_cpp/src/session_counter.cpp
#include <unordered_map>

#include <ros/ros.h>
#include <std_srvs/Trigger.h>

class Counter {
 public:
  explicit Counter(ros::NodeHandle& node) : server_(node.advertiseService("/count", &Counter::count, this)) {}

 private:
  bool count(ros::ServiceEvent<std_srvs::TriggerRequest, std_srvs::TriggerResponse>& call) {
    ros::M_string& header = call.getConnectionHeader();
    if (header.count("session") == 0) throw std::runtime_error("no session");
    int& number = numbers_[header["session"]];
    number += 1;
    call.getResponse().message = std::to_string(number);
    call.getResponse().success = true;
    return true;
  }

  std::unordered_map<std::string, int> numbers_;
  ros::ServiceServer server_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "session_counter");
  ros::NodeHandle node;
  Counter counter(node);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  ros::waitForShutdown();
}
"""

# %% 14.9 wrong: uses one count for all sessions | hint: The response contains the number of all calls
replace('++calls[session->second]', '++calls["all"]')
# %% 14.9 wrong: counts the calls of each node | hint: The response contains the number of all calls
replace('++calls[session->second]', '++calls[event.getCallerName()]')
# %% 14.9 wrong: counts the calls of each session and node | hint: The handler uses the name of the calling node
replace('++calls[session->second]', '++calls[session->second + event.getCallerName()]')
# %% 14.9 wrong: stores the counts of only three sessions | hint: The response does not contain the number of calls in the session
replace('++calls[session->second]', '++calls[calls.size() < 3 || calls.count(session->second) ? session->second : "more"]')
# %% 14.9 wrong: refuses only the first call without a session | hint: A response with success=false is not a refusal
replace('  if (session == header.end()) {', '  static int refused = 0;\n  if (session == header.end()) {\n    if (refused++) return true;')
# %% 14.9 wrong: returns the count before the call | hint: The response contains the number of calls before this call
replace('++calls[session->second]', 'calls[session->second]++')
# %% 14.9 wrong: creates the map in the handler | hint: The response to every call in this session is 1
replace('std::map<std::string, int> calls;\n', '')
replace('bool handleCount(Event& event) {\n', 'bool handleCount(Event& event) {\n  std::map<std::string, int> calls;\n')
# %% 14.9 wrong: counts only the sessions a and b | hint: The response to every call in this session is 1
replace('++calls[session->second]', '(session->second == "a" || session->second == "b" ? ++calls[session->second] : 1)')
# %% 14.9 wrong: returns no message | hint: The message is empty
replace('event.getResponse().message = std::to_string(++calls[session->second])', '++calls[session->second]')
# %% 14.9 wrong: does not check whether the field exists | hint: The header had no field "session", but the response contains a count
replace('  if (session == header.end()) {\n    return false;\n  }\n', '  std::string key = session == header.end() ? "" : session->second;\n')
replace('++calls[session->second]', '++calls[key]')
# %% 14.9 wrong: reads another field | hint: The response does not contain the number of calls in the session
replace('find("session")', 'find("Session")')
# %% 14.9 wrong: refuses a session with an empty name | hint: The handler refused a session with an empty name
replace("session == header.end()", "session == header.end() || session->second.empty()")
# %% 14.9 wrong: forgets all sessions when there are more than twenty | hint: Keep the counts of all sessions
replace("  event.getResponse().success = true;\n", "  if (calls.size() > 20) calls.clear();\n  event.getResponse().success = true;\n")
# %% 14.9 wrong: counts in four threads without a lock | hint: Several calls at the same time got wrong numbers
replace("  event.getResponse().success = true;\n", "  int seen = calls[session->second];\n  ros::WallDuration(0.01).sleep();  // for example, it writes a line to a file\n  calls[session->second] = seen + 1;\n  event.getResponse().success = true;\n")
replace("std::to_string(++calls[session->second])", "std::to_string(seen + 1)")
replace("ros::spin();", "ros::MultiThreadedSpinner spinner(4);\n  spinner.spin();")
