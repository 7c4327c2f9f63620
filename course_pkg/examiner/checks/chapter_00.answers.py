"""What students answer in chapter 00; see answers.py for the form of this file."""

# %% before
import rospy
from course_pkg import join
from course_pkg.srv import geometry
from std_msgs.msg import UInt32

node = join("chapter_00")
server = node.run("course_pkg", "server")
server.wait_for_service("/getGeometry", timeout=10)

# %% 00.1 right: three names
name_of_node = "/SERVER_NODE"
name_of_service = "/getGeometry"
name_of_type = "course_pkg/geometry"

# %% 00.1 right: asked for
import rosservice

name_of_service = "/getGeometry"
name_of_node = rosservice.get_service_node(name_of_service)
name_of_type = rosservice.get_service_type(name_of_service)

# %% 00.1 wrong: the program for the node | hint: That is the program
name_of_node = "/server"
name_of_service = "/getGeometry"
name_of_type = "course_pkg/geometry"

# %% 00.1 wrong: no slash | hint: start with a slash
name_of_node = "SERVER_NODE"
name_of_service = "getGeometry"
name_of_type = "course_pkg/geometry"

# %% 00.1 wrong: this notebook | hint: Who answers
name_of_node = "/chapter_00"
name_of_service = "/getGeometry"
name_of_type = "course_pkg/geometry"

# %% 00.1 wrong: a service that every node has | hint: Every node has that one
name_of_node = "/SERVER_NODE"
name_of_service = "/SERVER_NODE/get_loggers"
name_of_type = "course_pkg/geometry"

# %% 00.1 wrong: a type without its package | hint: package/type
name_of_node = "/SERVER_NODE"
name_of_service = "/getGeometry"
name_of_type = "geometry"

# %% 00.1 wrong: the type where the name belongs | hint: The name is what is called
name_of_node = "/SERVER_NODE"
name_of_service = "course_pkg/geometry"
name_of_type = "/getGeometry"

# %% 00.1 wrong: a slash at the end | hint: no slash stands at the end
name_of_node = "/SERVER_NODE"
name_of_service = "/getGeometry/"
name_of_type = "course_pkg/geometry"

# %% 00.1 wrong: the class | hint: The type is a text
name_of_node = "/SERVER_NODE"
name_of_service = "/getGeometry"
name_of_type = geometry

# %% 00.2 right: node.call
def ask_for_volume(service, length, width, height):
    return node.call(service, geometry, length, width, height).volume

# %% 00.2 right: the lines of the panel
def ask_for_volume(service, length, width, height):
    proxy = rospy.ServiceProxy(service, geometry)
    response = proxy(length=length, width=width, height=height)
    return response.volume

# %% 00.2 wrong: multiplies itself | hint: it was not asked for
def ask_for_volume(service, length, width, height):
    return length * width * height

# %% 00.2 wrong: asks, and multiplies all the same | hint: You multiplied
def ask_for_volume(service, length, width, height):
    node.call(service, geometry, length, width, height)
    return length * width * height

# %% 00.2 wrong: returns the area | hint: That is the area
def ask_for_volume(service, length, width, height):
    return node.call(service, geometry, length, width, height).area

# %% 00.2 wrong: returns the whole response | hint: the whole response
def ask_for_volume(service, length, width, height):
    return node.call(service, geometry, length, width, height)

# %% 00.2 wrong: asks the one server it knows | hint: it was not asked for
def ask_for_volume(service, length, width, height):
    return node.call("/getGeometry", geometry, length, width, height).volume

# %% 00.2 wrong: forgets to return | hint: without a return line
def ask_for_volume(service, length, width, height):
    node.call(service, geometry, length, width, height).volume

# %% 00.2 wrong: another order | hint: order of your arguments
def ask_for_volume(service, length, width, height):
    return node.call(service, geometry, height, width, length).volume

# %% 00.2 wrong: rounds it | hint: without its fraction
def ask_for_volume(service, length, width, height):
    return round(node.call(service, geometry, length, width, height).volume)

# %% 00.2 wrong: as text | hint: the volume as a text
def ask_for_volume(service, length, width, height):
    return str(node.call(service, geometry, length, width, height).volume)

# %% 00.2 wrong: area times height | hint: return its volume
def ask_for_volume(service, length, width, height):
    return node.call(service, geometry, length, width, height).area * height

# %% 00.2 wrong: leaves the height out | hint: One arrived as 0
def ask_for_volume(service, length, width, height):
    return node.call(service, geometry, length=length, width=width).volume

# %% 00.2 wrong: a tuple | hint: Return the volume alone
def ask_for_volume(service, length, width, height):
    r = node.call(service, geometry, length, width, height)
    return r.area, r.volume

# %% 00.3 right: subscribe and wait
def listen(topic):
    return [message.data for message in node.subscribe(topic, UInt32).wait(3, timeout=10)]

# %% 00.3 right: a subscriber of rospy's
def listen(topic):
    numbers = []
    subscriber = rospy.Subscriber(topic, UInt32, lambda message: numbers.append(message.data))
    while len(numbers) < 3:
        rospy.sleep(0.05)
    subscriber.unregister()
    return numbers[:3]

# %% 00.3 wrong: returns the messages | hint: whole messages
def listen(topic):
    return list(node.subscribe(topic, UInt32).wait(3, timeout=10))

# %% 00.3 wrong: newest first | hint: in the order in which they came
def listen(topic):
    heard = [message.data for message in node.subscribe(topic, UInt32).wait(3, timeout=10)]
    return heard[::-1]

# %% 00.3 wrong: one only | hint: One value is no list
def listen(topic):
    return rospy.wait_for_message(topic, UInt32).data

# %% 00.3 wrong: two of them | hint: Wait for three
def listen(topic):
    return [message.data for message in node.subscribe(topic, UInt32).wait(2, timeout=10)]

# %% 00.3 wrong: made up | hint: Nobody publishes those on the topic
def listen(topic):
    return [1, 2, 3]

# %% 00.3 wrong: as text | hint: Those are texts
def listen(topic):
    return [str(message.data) for message in node.subscribe(topic, UInt32).wait(3, timeout=10)]

# %% 00.3 wrong: counts on from one message | hint: the topic does not count in ones
def listen(topic):
    first = rospy.wait_for_message(topic, UInt32).data
    return [first, first + 1, first + 2]

# %% 00.3 wrong: one message thrice | hint: stands there twice
def listen(topic):
    return [rospy.wait_for_message(topic, UInt32).data] * 3

# %% 00.3 wrong: every other one | hint: is missing
def listen(topic):
    return [message.data for message in node.subscribe(topic, UInt32).wait(5, timeout=10)][::2]

# %% 00.3 wrong: a generator | hint: list(...) makes one
def listen(topic):
    return (message.data for message in node.subscribe(topic, UInt32).wait(3, timeout=10))

# %% 00.3 wrong: all that came in two seconds | hint: Those are too many
import time
def listen(topic):
    numbers = []
    s = rospy.Subscriber(topic, UInt32, lambda message: numbers.append(message.data))
    time.sleep(2)
    s.unregister()
    return numbers

# %% 00.3 wrong: of another type | hint: with the type UInt32
from std_msgs.msg import String
def listen(topic):
    return [message.data for message in node.subscribe(topic, String).wait(3, timeout=3)]
