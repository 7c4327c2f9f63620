"""Example answers of chapter 00; tests/checking/answers/example_answers.py explains the format."""

# %% 00.1 right: gives the three names as strings
solution()
# %% 00.1 right: reads the names from the graph
replace('name_of_node = "/SERVER_NODE"', "import rosservice\n")
replace('name_of_type = "course_pkg/geometry"', """name_of_node = rosservice.get_service_node(name_of_service)
name_of_type = rosservice.get_service_type(name_of_service)""")
# %% 00.1 wrong: gives the name of the program instead of the node | hint: Your answer is the name of the program.
replace('"/SERVER_NODE"', '"/server"')
# %% 00.1 wrong: omits the slash at the beginning of the names | hint: Your answer is almost right
replace("/SERVER_NODE", "SERVER_NODE")
replace("/getGeometry", "getGeometry")
# %% 00.1 wrong: gives the name of this notebook's node | hint: Your answer is the node
replace('"/SERVER_NODE"', '"/chapter_00"')
# %% 00.1 wrong: gives a service that every node offers | hint: Every node offers a service for
replace('"/getGeometry"', '"/SERVER_NODE/get_loggers"')
# %% 00.1 wrong: gives the type without its package | hint: The name of the package
replace("course_pkg/geometry", "geometry")
# %% 00.1 wrong: exchanges the service and the type | hint: Your answer is the type
replace("/getGeometry", "course_pkg/geometry")
replace('name_of_type = "course_pkg/geometry"', 'name_of_type = "/getGeometry"')
# %% 00.1 wrong: adds a slash at the end of the service | hint: Compare your answer with the
replace('"/getGeometry"', '"/getGeometry/"')
# %% 00.1 wrong: gives the service class instead of the name of the type | hint: Your answer is the Python
replace('"course_pkg/geometry"', "geometry")
# %% 00.1 wrong: stores the lines that a command printed | hint: Your answer is a list of lines
replace('"/SERVER_NODE"', "!rosservice node /getGeometry")
replace('"/getGeometry"', "!rosservice find course_pkg/geometry")
replace('"course_pkg/geometry"', "!rosservice type /getGeometry")
# %% 00.1 wrong: gives the service instead of the node | hint: Your answer is the name of a
replace('"/SERVER_NODE"', '"/getGeometry"')
# %% 00.1 wrong: gives the node instead of the service | hint: The command `rosservice list` shows
replace('name_of_node = "/SERVER_NODE"\nname_of_service = "/getGeometry"', 'name_of_node = name_of_service = "/SERVER_NODE"')
# %% 00.1 wrong: adds a slash before the type | hint: The name of a type
replace("course_pkg", "/course_pkg")
# %% 00.1 wrong: gives the name of the service instead of the type | hint: The command `rosservice type`
replace("course_pkg/geometry", "/getGeometry")
# %% 00.1 wrong: writes the type with a capital letter | hint: The name of this type
replace("pkg/geometry", "pkg/Geometry")

# %% 00.1 wrong: gives names that do not exist | hint: is not the name of the server's node … not the name of the service that … is not the type of
replace("/SERVER_NODE", "/something")
replace("/getGeometry", "/something")
replace("course_pkg/geometry", "something")

# %% 00.2 right: passes the sides by position
def ask_for_volume(service, length, width, height):
    measure = rospy.ServiceProxy(service, geometry)
    return measure(length, width, height).volume

# %% 00.2 right: uses the Python code that the panel shows
def ask_for_volume(service, length, width, height):
    proxy = rospy.ServiceProxy(service, geometry)
    response = proxy(length=length, width=width, height=height)
    return response.volume

# %% 00.2 right: waits first, and sends a request object
from course_pkg.srv import geometryRequest

def ask_for_volume(service, length, width, height):
    rospy.wait_for_service(service, timeout=5)
    return rospy.ServiceProxy(service, geometry).call(geometryRequest(length, width, height)).volume

# %% 00.2 wrong: multiplies without a call | hint: Your function did not call
def ask_for_volume(service, length, width, height):
    return length * width * height

# %% 00.2 wrong: calls the service, but returns its own product of the sides | hint: Your function multiplied the sides
replace("return measure(length, width, height).volume", "measure(length, width, height)\n    return length * width * height")
# %% 00.2 wrong: returns the area | hint: Your function returned the area.
replace(".volume", ".area")
# %% 00.2 wrong: returns the whole response | hint: Your function returned the whole
replace(".volume", "")
# %% 00.2 wrong: calls a fixed service name | hint: Your function did not call
replace("service, geometry", '"/getGeometry", geometry')
# %% 00.2 wrong: forgets to return | hint: without a return statement
replace("return measure", "measure")
# %% 00.2 wrong: passes the sides in another order | hint: The order of the sides
replace("measure(length, width, height)", "measure(height, width, length)")
# %% 00.2 wrong: rounds the volume | hint: Do not round the volume.
replace("measure(length, width, height).volume", "round(measure(length, width, height).volume)")
# %% 00.2 wrong: rounds the volume to three decimals | hint: Do not round the volume.
replace("measure(length, width, height).volume", "round(measure(length, width, height).volume, 3)")
# %% 00.2 wrong: rounds the sides to millimetres | hint: The numbers in the request differ
replace("measure(length, width, height)", "measure(*(round(side, 3) for side in (length, width, height)))")
# %% 00.2 wrong: returns the volume as a string | hint: the volume as a string
replace("measure(length, width, height).volume", "str(measure(length, width, height).volume)")
# %% 00.2 wrong: returns the area times the height | hint: Your function multiplied the area
replace(".volume", ".area * height")
# %% 00.2 wrong: omits the height | hint: One side in the request is 0
replace("measure(length, width, height)", "measure(length=length, width=width)")
# %% 00.2 wrong: rounds the sides to whole metres | hint: The numbers in the request differ
replace("measure(length, width, height)", "measure(length // 1 + 1, width // 1 + 1, height // 1 + 1)")
# %% 00.2 wrong: returns a tuple of area and volume | hint: Your function returned more than
based_on("uses the Python code that the panel shows")
replace("proxy = rospy … response.volume", "r = rospy.ServiceProxy(service, geometry)(length, width, height)\n    return r.area, r.volume")

# %% 00.2 wrong: stores the results | hint: The check called ask_for_volume() twice
import functools


@functools.lru_cache
def ask_for_volume(service, length, width, height):
    return rospy.ServiceProxy(service, geometry)(length, width, height).volume

# %% 00.2 wrong: sends other sides in the second call | hint: The numbers in the request differ
replace("height):", "height, calls=[]):\n    calls.append(service)")
replace("(length, width, height).volume", "(*(length, width, height) if len(calls) % 2 else (1, 1, 1)).volume")

# %% 00.2 wrong: converts the volume to another unit | hint: Return the volume from the response without
replace(".volume", ".volume / 1000")

# %% 00.3 right: uses wait_for_message
def count_missed(topic, pause):
    before = rospy.wait_for_message(topic, UInt32, timeout=10).data
    time.sleep(pause)
    after = rospy.wait_for_message(topic, UInt32, timeout=10).data
    return before, after, after - before - 1

# %% 00.3 right: uses a subscriber with a callback
def count_missed(topic, pause):
    numbers = []

    def one():
        subscriber = rospy.Subscriber(topic, UInt32, lambda message: numbers.append(message.data))
        start = len(numbers)
        while len(numbers) == start:
            rospy.sleep(0.005)
        subscriber.unregister()
        return numbers[start]

    first = one()
    rospy.sleep(pause)
    second = one()
    return [first, second, len(range(first + 1, second))]

# %% 00.3 wrong: counts the second number as missed | hint: Your count includes one of
replace(" - 1", "")
# %% 00.3 wrong: counts both received numbers as missed | hint: Your count includes both numbers
replace("before - 1", "before + 1")
# %% 00.3 wrong: subtracts the numbers in the wrong order | hint: Your count is negative. Subtract
replace("after - before - 1", "before - after + 1")
# %% 00.3 wrong: returns only the count | hint: Your function returned only one
replace("before, after, after - before - 1", "after - before - 1")
# %% 00.3 wrong: returns only two numbers | hint: Return the three numbers in one line
replace("before, after, after - before - 1", "before, after")
# %% 00.3 wrong: does not pause | hint: The time between the two
replace("    time.sleep(pause)\n", "")
# %% 00.3 wrong: always uses the pause from the chapter | hint: The time between the two numbers
replace("sleep(pause)", "sleep(2)")
# %% 00.3 wrong: always pauses for 3 s | hint: The pause is too long
replace("sleep(pause)", "sleep(3)")
# %% 00.3 wrong: treats the pause as milliseconds | hint: The pause is too long
replace("sleep(pause)", "sleep(1000 * pause)")
# %% 00.3 wrong: returns messages instead of numbers | hint: Your function returned a whole
replace("return before, after,", "return UInt32(before), UInt32(after),")
# %% 00.3 wrong: returns the later number first | hint: The order of the two
replace("return before, after,", "return after, before,")
# %% 00.3 wrong: uses a fixed topic | hint: No message arrived, although
replace("(topic, UInt32", '("/nothing_here", UInt32', times=2)
# %% 00.3 wrong: returns fixed numbers | hint: The numbers that your function
replace("return before, after, after - before - 1", "return 17, 25, 7")
# %% 00.3 wrong: estimates the second number | hint: The second number was not published
replace("return before, after, after - before - 1", "return before, before + 500, 499")
# %% 00.3 wrong: estimates the count from the rate | hint: Calculate the third number from the first two
replace("after - before - 1", "int(pause * 2)")
# %% 00.3 wrong: returns the count as a float | hint: The three results have to
replace("after - before - 1", "(after - before - 1) / 1")
# %% 00.3 wrong: forgets to return | hint: without a return statement
replace("return before, after, after - before - 1", "missed = after - before - 1")
# %% 00.3 wrong: subscribes with another message type | hint: Receive messages of the type UInt32
replace("UInt32", "String", times=2)
# %% 00.3 wrong: also receives messages during the pause | hint: Your function received numbers during
def count_missed(topic, pause):
    numbers = []
    rospy.Subscriber(topic, UInt32, lambda message: numbers.append(message.data))
    time.sleep(pause + 0.3)
    return numbers[0], numbers[-1], len(numbers) - 2

# %% 00.3 wrong: calculates the second number instead of receiving it | hint: a number that it did not receive
replace("after = rospy.wait_for_message(topic, UInt32, timeout=10).data", "time.sleep(1)\n    after = before + 20")
# %% 00.3 wrong: receives only the second number | hint: a number that it did not receive
replace("before = rospy.wait_for_message(topic, UInt32, timeout=10).data", "time.sleep(1)")
replace("timeout=10).data\n", "timeout=10).data\n    before = after - 20\n")
# %% 00.3 wrong: receives during most of the pause | hint: Your function received numbers during
def count_missed(topic, pause):
    numbers = [rospy.wait_for_message(topic, UInt32).data]
    time.sleep(0.2)
    rospy.Subscriber(topic, UInt32, lambda message: numbers.append(message.data))
    time.sleep(pause)
    return numbers[0], numbers[-1], numbers[-1] - numbers[0] - 1

# %% 00.3 wrong: also receives numbers at the end of the pause | hint: Your function received numbers during
def count_missed(topic, pause):
    numbers = [rospy.wait_for_message(topic, UInt32).data]
    time.sleep(0.8 * pause)
    subscriber = rospy.Subscriber(topic, UInt32, lambda message: numbers.append(message.data))
    time.sleep(0.2 * pause + 0.1)
    subscriber.unregister()
    return numbers[0], numbers[-1], numbers[-1] - numbers[0] - 1
