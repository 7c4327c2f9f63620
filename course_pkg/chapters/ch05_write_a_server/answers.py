"""Example answers of chapter 05; tests/checking/answers/example_answers.py explains the format."""

# %% 05.1 right: returns a response object
def handle_geometry(request):
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)


geometry_service = rospy.Service("/getGeometry", geometry, handle_geometry)

# %% 05.1 right: returns a tuple
replace("""area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)""", "return request.length * request.width, request.length * request.width * request.height")

# %% 05.1 right: creates a response and then sets its fields
def handle_geometry(request):
    response = geometryResponse()
    response.area = request.width * request.length
    response.volume = response.area * request.height
    return response


geometry_service = rospy.Service("/getGeometry", geometry, handle_geometry)

# %% 05.1 right: uses an object that creates its service
import functools


def handle_geometry(factor, request):
    area = factor * request.width * request.length
    return {"volume": area * request.height, "area": area}


class Server:
    def __init__(self):
        self.service = rospy.Service("/getGeometry", geometry, functools.partial(handle_geometry, 1))


server = Server()

# %% 05.1 right: passes a lambda function
replace("geometryResponse(area=area, volume=area * request.height)", "area, area * request.height")
replace('("/getGeometry", geometry, handle_geometry)', '("/getGeometry", geometry, lambda request: handle_geometry(request))')
# %% 05.1 wrong: misspells a field | hint: The request has no field
replace("request.width", "request.breadth")
# %% 05.1 wrong: omits the parameter of the handler | hint: The handler has no parameter
replace("handle_geometry(request):", "handle_geometry():")
# %% 05.1 wrong: passes the result of the handler instead of the handler | hint: Pass the name of the handler without
replace("geometry, handle_geometry)", "geometry, handle_geometry(geometry._request_class()))")
# %% 05.1 wrong: never creates the service | hint: The service does not exist.
replace('rospy.Service("/getGeometry", geometry, handle_geometry)', "None")
# %% 05.1 wrong: adds instead of multiplying | hint: Your area is width +
replace("width * request", "width + request")
# %% 05.1 wrong: returns the area of the front instead of the floor | hint: Your area is the area of a wall
replace("length", "height")
replace("(area=area, volume=area * request.height)", "(area=area, volume=area * request.length)")
# %% 05.1 wrong: returns the volume first | hint: The field `area` contains the
replace("geometryResponse(area=area, volume=area * request.height)", "area * request.height, area")
# %% 05.1 wrong: forgets the volume | hint: The volume is 0
replace("""area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)""", "return geometryResponse(area=request.width * request.length)")
# %% 05.1 wrong: forgets to return | hint: None
based_on("creates a response and then sets its fields")
replace("\n    return response", "")
# %% 05.1 wrong: adds the height | hint: Your volume is area +
replace("area * request", "area + request")
# %% 05.1 wrong: rounds area and volume to whole numbers | hint: The area is rounded
replace("\n    area = request.width * request.length\n    return geometryResponse(area=area, volume=area * request.height)", """
    return round(request.width * request.length), round(request.width * request.length * request.height)""")
# %% 05.1 wrong: rounds the volume to a whole number | hint: Your volume is rounded
replace("volume=area * request.height", "volume=round(area * request.height)")
# %% 05.1 wrong: rounds area and volume to two digits | hint: The area is rounded
replace("area=area, volume=area * request.height", "area=round(area, 2), volume=round(area * request.height, 2)")
# %% 05.1 wrong: rounds the volume to two digits | hint: Your volume is rounded
replace("volume=area * request.height", "volume=round(area * request.height, 2)")
# %% 05.1 wrong: rounds area and volume to five digits | hint: Your volume is rounded
replace("area=area, volume=area * request.height", "area=round(area, 5), volume=round(area * request.height, 5)")
# %% 05.1 wrong: returns the area in square centimetres | hint: This area is in square centimetres
replace("area=area", "area=area * 10000")
# %% 05.1 wrong: returns the volume in cubic centimetres | hint: Your volume is in cubic centimetres
replace("volume=area * request.height", "volume=area * request.height * 1e6")
# %% 05.1 wrong: returns the area of all six sides | hint: The area is wrong. Return
replace("""area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)""", """l, w, h = request.length, request.width, request.height
    return geometryResponse(area=2 * (l * w + l * h + w * h), volume=l * w * h)""")
# %% 05.1 wrong: removes the digits after the decimal point of the sides | hint: Your handler uses only whole numbers
replace("""area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)""", """length, width, height = int(request.length), int(request.width), int(request.height)
    return geometryResponse(area=length * width, volume=length * width * height)""")
# %% 05.1 wrong: shuts the service down some time after the fifth call | hint: The service ended some time after
replace("def handle_geometry(request):", """import threading

calls = []


def handle_geometry(request):
    calls.append(request)
    if len(calls) == 5:
        threading.Timer(0.4, geometry_service.shutdown).start()""")
# %% 05.1 wrong: returns the area as the volume | hint: The field `volume` contains the area
replace("volume=area * request.height", "volume=area")
# %% 05.1 wrong: uses the width instead of the height for the volume | hint: Multiply all three sides
replace("area * request.height", "area * request.width")
# %% 05.1 wrong: returns the right area only for usual sizes | hint: The area is 0
replace("area = request.width * request.length", "area = request.width * request.length * (0.49 < request.width < 9.01)")
# %% 05.1 wrong: forgets the area | hint: The area is 0
replace("area=area, volume", "volume")

# %% 05.1 right: uses a bound method, and no function handle_geometry
class Geometer:
    def handle(self, request):
        return request.width * request.length, request.width * request.length * request.height


geometry_service = rospy.Service("/getGeometry", geometry, Geometer().handle)

# %% 05.1 wrong: creates a client instead of a server | hint: The service does not exist. … rospy.Service
replace('rospy.Service("/getGeometry", geometry, handle_geometry)', 'rospy.ServiceProxy("/getGeometry", geometry)')
# %% 05.1 wrong: starts another program that offers the service | hint: Another program provides the service with the name
import subprocess
import sys

SERVER = """
import rospy
from course_pkg.srv import geometry
rospy.init_node("measurer")
rospy.Service("/getGeometry", geometry, lambda request: (request.length * request.width, 1.0))
rospy.spin()
"""
subprocess.Popen([sys.executable, "-c", SERVER])
rospy.wait_for_service("/getGeometry", timeout=15)
handle_geometry = geometry_service = print

# %% 05.2 right: uses a class that counts
class Counter:
    def __init__(self):
        self.count = 0

    def handle_count(self, request):
        self.count += 1
        return TriggerResponse(success=True, message=str(self.count))

    def handle_reset(self, request):
        self.count = 0
        return EmptyResponse()


counter = Counter()
count_service = rospy.Service("/count", Trigger, counter.handle_count)
reset_service = rospy.Service("/reset_count", Empty, counter.handle_reset)

# %% 05.2 right: uses the shortest possible code
replace("def __init__(self):\n        self.count = 0", "count = 0")
replace("self.count += 1\n        return TriggerResponse(success=True, message=str(self.count))", '''self.count = self.count + 1
        return True, f"{self.count}"''')
replace("EmptyResponse()", "[]")
# %% 05.2 right: uses an object that creates its services
replace("def __init__(self):\n        self.count = 0", """def __init__(self):
        self.count = 0
        self.services = [
            rospy.Service("/count", Trigger, self.handle_count),
            rospy.Service("/reset_count", Empty, self.handle_reset),
        ]""")
replace("\ncount_service … handle_reset)", "")
# %% 05.2 wrong: omits self | hint: The handler is a method
replace("def handle_count(self, request):", "def handle_count(request):")
# %% 05.2 wrong: assigns to a local variable before it has a value | hint: The handler assigns a value … Your cell, line
replace("self.count += 1", "count += 1")
# %% 05.2 wrong: uses a name that does not exist | hint: The handler uses a name that does not exist
replace("str(self.count)", "str(counted)")
# %% 05.2 wrong: returns None from the reset | hint: The handler returned None. Return
replace("self.count = 0\n        return EmptyResponse()", "self.count = 0")
# %% 05.2 wrong: returns the old count | hint: The message is 0 after
replace("def handle_count(self, request):", "def handle_count(self, request):\n        before = self.count")
replace("(self.count)", "(before)")
# %% 05.2 wrong: does not reset the count | hint: The count continued after the reset.
replace("self.count = 0\n        return EmptyResponse()", "return EmptyResponse()")
# %% 05.2 wrong: resets another object | hint: use the same Counter object for both services
replace("counter.handle_reset", "Counter().handle_reset")
# %% 05.2 wrong: counts in a local variable | hint: The message is also 1 after the second call. Store
replace("self.count += 1", "count = 0\n        count += 1")
replace("str(self.count)", "str(count)")
# %% 05.2 wrong: omits success | hint: success is False, because ROS
replace("success=True, message", "message")
# %% 05.2 wrong: counts only to 9 | hint: For counts above 9, the
replace("self.count += 1", "self.count = self.count % 9 + 1")
# %% 05.2 wrong: starts again after 13 calls | hint: For counts above 9, the
replace("self.count += 1", "self.count = self.count % 13 + 1")
# %% 05.2 wrong: returns only the last digit | hint: For counts above 9, the
replace("(self.count)", "(self.count)[-1]")
# %% 05.2 wrong: returns more text than the number | hint: The message contains more than the number
replace("str(self.count)", 'f"{self.count} calls"')
# %% 05.2 wrong: always returns two digits | hint: The message begins with an extra zero
replace("str(self.count)", 'f"{self.count:02d}"')
# %% 05.2 wrong: returns an int as the message | hint: Convert the count
replace("str(self.count)", "self.count")
# %% 05.2 wrong: omits the message | hint: Set the message to the
replace(", message=str(self.count)", "")

# %% 05.2 right: uses functions without a class
total = 0


def handle_count(request):
    global total
    total += 1
    return TriggerResponse(True, str(total))


def handle_reset(request):
    global total
    total = 0
    return EmptyResponse()


count_service = rospy.Service("/count", Trigger, handle_count)
reset_service = rospy.Service("/reset_count", Empty, handle_reset)

# %% 05.2 wrong: starts the count at 1 | hint: A new counter did not
replace("def __init__(self):\n        self.count = 0", "def __init__(self):\n        self.count = 1")
# %% 05.2 wrong: resets the count to 1 | hint: The first call after a
replace("self.count = 0\n        return", "self.count = 1\n        return")
# %% 05.2 wrong: exchanges the handlers of the two services | hint: The handler of /count returned an
replace("Trigger, counter.handle_count", "Trigger, counter.handle_reset")
# %% 05.2 wrong: uses one count for all objects | hint: A new counter did not
replace("self.count", "Counter.count", times=4)
replace("def __init__(self):\n        Counter.count = 0", "count = 0")
# %% 05.2 wrong: counts the calls of each client separately | hint: Each client has a separate
replace("self.count = 0", "self.count = {}", times=2)
replace("self.count += 1", 'client = request._connection_header["callerid"]\n        self.count[client] = self.count.get(client, 0) + 1')
replace("str(self.count)", "str(self.count[client])")

# %% 05.3 right: uses a loop over the sides
def handle_checked_geometry(request):
    for side in ("length", "width", "height"):
        value = getattr(request, side)
        if value < 0:
            raise rospy.ServiceException(f"{side} is {value}, and a side cannot be negative")
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)


checked_service = rospy.Service("/getGeometryChecked", geometry, handle_checked_geometry)

# %% 05.3 right: uses one if statement for each side
def handle_checked_geometry(request):
    if request.length < 0:
        raise rospy.ServiceException("negative length: %g" % request.length)
    if request.width < 0:
        raise rospy.ServiceException("negative width: %g" % request.width)
    if request.height < 0:
        raise rospy.ServiceException("negative height: %g" % request.height)
    return [request.length * request.width, request.length * request.width * request.height]


checked_service = rospy.Service("/getGeometryChecked", geometry, handle_checked_geometry)

# %% 05.3 right: begins the names of the sides with a capital letter
replace("for side in … request.height)", """sides = {"Length": request.length, "Width": request.width, "Height": request.height}
    negative = [f"{name} is {value} m" for name, value in sides.items() if value < 0]
    if negative:
        raise rospy.ServiceException(negative[0])
    return request.length * request.width, request.length * request.width * request.height""")
# %% 05.3 wrong: accepts negative sides | hint: The server measured a box with a negative side
replace('\n    for side in … negative")', "")
# %% 05.3 wrong: raises a ValueError | hint: The handler raised an exception of the wrong type
replace("rospy.ServiceException", "ValueError")
# %% 05.3 wrong: returns None | hint: The handler returned None, so the
replace('raise rospy.ServiceException(f"{side} is {value}, and a side cannot be negative")', "return None")
# %% 05.3 wrong: omits the name of the side in the error message | hint: The message does not contain the name of a side
replace('f"{side} is {value}, and a side cannot be negative"', '"no such box"')
# %% 05.3 wrong: returns an empty response for a negative side | hint: The server measured a box with a negative side
replace('raise rospy.ServiceException(f"{side} is {value}, and a side cannot be negative")', "return geometryResponse()")
# %% 05.3 wrong: also refuses a side of length 0 | hint: not zero itself
replace("value < 0", "value <= 0")
# %% 05.3 wrong: returns the exception | hint: Do not return the exception
replace("raise rospy.ServiceException", "return rospy.ServiceException")
# %% 05.3 wrong: returns the error message as text | hint: Do not return the exception
replace('raise rospy.ServiceException(f"{side} is {value}, and a side cannot be negative")\n    ', 'return f"{side} is {value}"\n    ')
# %% 05.3 wrong: compares the sides without their fractions | hint: The server measured a box
replace("value < 0", "int(value) < 0")
# %% 05.3 wrong: omits the value of the side | hint: The message does not contain the value
replace("{value}, and a side cannot be negative", "negative")
# %% 05.3 wrong: writes a whole number in the message | hint: The message contains a rounded value.
replace("{value}, and", "{int(value)}, and")
# %% 05.3 wrong: writes the value with one decimal in the message | hint: The message contains a rounded value.
replace("{value}, and", "{value:.1f}, and")
# %% 05.3 wrong: writes the value with two decimals in the message | hint: The message contains a rounded value.
replace("{value}, and", "{value:.2f}, and")
# %% 05.3 wrong: starts another program that offers the service, and leaves the handler empty | hint: Another program provides the service with the name
import subprocess
import sys


def handle_checked_geometry(request):
    """Return area and volume, or refuse with rospy.ServiceException."""


SERVER = """
import rospy
from course_pkg.srv import geometry
rospy.init_node("measurer")
rospy.Service("/getGeometryChecked", geometry, lambda request: (request.length * request.width, 1.0))
rospy.spin()
"""
checked_service = subprocess.Popen([sys.executable, "-c", SERVER])
rospy.wait_for_service("/getGeometryChecked", timeout=15)

# %% 05.3 wrong: writes the whole request into the message | hint: The message contains the names of more than one
replace('"{side} is {value}, and a side cannot be negative"', '"a negative side in {request}"')
# %% 05.3 wrong: writes only the values of all sides into the message | hint: The message does not contain the name of a side
replace("{side} is {value}, and a side cannot be negative", "{request.length}, {request.width}, {request.height}")
# %% 05.3 wrong: names the last negative side | hint: contains the name of the wrong side
replace('("length", "width", "height")', '("height", "width", "length")')
# %% 05.3 wrong: also refuses a length of 0 | hint: not zero itself
replace("value < 0", "value < 0 or not request.length")
# %% 05.3 wrong: rounds area and volume to three digits | hint: The area or the volume of a box is not exact
replace("area=area, volume=area * request.height", "area=round(area, 3), volume=round(area * request.height, 3)")
# %% 05.3 wrong: accepts a side that is only slightly negative | hint: with a side that is only slightly negative
replace("value < 0", "value < -1e-5")
# %% 05.3 wrong: does not check the width | hint: The server measured a box with a negative side
replace('("length", "width", "height")', '("length", "height")')

# %% 05.3 right: uses an object, and no function handle_checked_geometry
class Checked:
    def __call__(self, request):
        for side in request.__slots__:
            if not getattr(request, side) >= 0:
                raise rospy.ServiceException(f"{side} is {getattr(request, side)}")
        return request.length * request.width, request.length * request.width * request.height


checked_service = rospy.Service("/getGeometryChecked", geometry, Checked())

# %% 05.3 wrong: names all sides | hint: The message contains the names of more than one
replace('f"{side} is {value}, and a side cannot be negative"', 'f"length is {request.length}, width is {request.width}, height is {request.height}"')
# %% 05.3 wrong: forgets the f before the string | hint: The message contains braces
replace('f"{side}', '"{side}')
# %% 05.3 wrong: writes too many values into the message | hint: The message contains too many
replace("{value}", "{[-number / 2 for number in range(100)]}")

# %% 05.4 right: compares first, and then sets the position
class Switch:
    def __init__(self):
        self.on = False

    def handle_switch(self, request):
        moved = request.data != self.on
        self.on = request.data
        return SetBoolResponse(success=moved, message="on" if self.on else "off")


switch = Switch()
switch_service = rospy.Service("/switch", SetBool, switch.handle_switch)

# %% 05.4 right: returns early
replace("def __init__(self):\n        self.on = False", 'state = "off"')
replace('moved = request … else "off")', """wanted = {True: "on", False: "off"}[request.data]
        if wanted == self.state:
            return {"success": False, "message": self.state}
        self.state = wanted
        return {"success": True, "message": wanted}""")
# %% 05.4 right: uses an object that creates its service
replace("False", 'False\n        self.service = rospy.Service("/switch", SetBool, self.handle_switch)')
replace('\nswitch_service = rospy.Service("/switch", SetBool, switch.handle_switch)', "")
# %% 05.4 wrong: returns success=True in every call | hint: in the wanted position, but success is True … A new switch is off, so
replace("success=moved", "success=True")
# %% 05.4 wrong: changes the position before it compares | hint: The switch moved, but success is
replace("\n        moved = request.data != self.on", "")
replace("moved", "request.data != self.on")
# %% 05.4 wrong: counts only moves to on | hint: A move to off counts, too
replace("moved = request.data != self.on", "moved = request.data and not self.on")
# %% 05.4 wrong: returns the old position | hint: Change the position first
replace("(self, request):", '(self, request):\n        message = "on" if self.on else "off"')
replace('message="on" if self.on else "off"', "message=message")
# %% 05.4 wrong: returns "True" or "False" as the message | hint: The message is "True" or
replace('"on" if self.on else "off"', "str(self.on)")
# %% 05.4 wrong: leaves the message empty | hint: Set the message to "on"
replace('"on" if self.on else "off"', '""')
# %% 05.4 wrong: switches off for True | hint: The field `data` is False, but
replace("self.on = request.data", "self.on = not request.data")
# %% 05.4 wrong: toggles in each call | hint: but the handler moved it … switched a new switch on
replace("self.on = request.data", "self.on = not self.on")
# %% 05.4 wrong: is on at the start | hint: A new switch was not off.
replace("False", "True")
# %% 05.4 wrong: is None at the start | hint: A new switch was not
replace("False", "None")
# %% 05.4 wrong: stores no position before the first move | hint: store the value that your handler stores for off
replace("self.on = False", "self.position = None")
replace("moved = request.data != self.on\n        self.on = request.data", """wanted = "on" if request.data else "off"
        moved = wanted != self.position
        self.position = wanted""")
replace('"on" if self.on else "off"', "wanted")
# %% 05.4 wrong: returns a sentence as the message | hint: The message contains more than "on"
replace('"on" if self.on else "off"', '"It is on" if self.on else "It is off"')
# %% 05.4 wrong: uses one value for all switches | hint: A new Switch() was on
replace("    def __init__(self):\n        self.on = False", "    on = False")
replace("self.on", "Switch.on", times=3)
# %% 05.4 wrong: raises an error if nothing changes | hint: It is not an error if the switch
replace("moved = request.data != self.on", 'if request.data == self.on:\n            raise rospy.ServiceException("already there")')
replace("success=moved", "success=True")

# %% 05.4 wrong: stores a separate position for each client | hint: Another client moved the switch to this position
replace("self.on = False", "self.positions = {}")
replace("moved = request.data != self.on\n        self.on = request.data", """client = request._connection_header["callerid"]
        moved = request.data != self.positions.get(client, False)
        self.positions[client] = request.data""")
replace("self.on else", "request.data else")
# %% 05.4 wrong: never stores the position | hint: in the wanted position, but success is True
replace("self.on = request.data\n", "pass\n")
replace('"on" if self.on else', '"on" if request.data else')

# %% 05.5 right: uses an object
solution()

# %% 05.5 right: uses global variables
"""%%writefile arm.py
#!/usr/bin/env python3
import rospy
from std_srvs.srv import SetBool, Trigger

moves = 0
service = None


def move(request):
    global moves
    moves = moves + 1
    return True, "%d" % moves


def maintenance(request):
    global service
    if request.data:
        if service is None:
            return False, "closed"
        service.shutdown()
        service = None
        return True, "closed"
    if service is not None:
        return False, "open"
    service = rospy.Service("/move_arm", Trigger, move)
    return True, "open"


def main():
    global service
    rospy.init_node("arm", anonymous=True)
    service = rospy.Service("/move_arm", Trigger, move)
    rospy.Service("/maintenance", SetBool, maintenance)
    rospy.spin()


if __name__ == "__main__":
    main()
"""

# %% 05.5 wrong: omits the shebang | hint: The shebang is missing: the first
replace("#!/usr/bin/env python3\n", "")
# %% 05.5 wrong: omits the main guard | hint: An import of the file starts the node
replace('if __name__ == "__main__":', "if True:")
# %% 05.5 wrong: misspells an imported name | hint: Python cannot import the file.
replace("import SetBool, SetBoolResponse", "import SetBol, SetBoolResponse")
# %% 05.5 wrong: omits init_node | hint: Call rospy.init_node before
replace('    rospy.init_node("arm")\n', "")
# %% 05.5 wrong: omits spin | hint: The program has ended, because
replace("    rospy.spin()\n", "")
# %% 05.5 wrong: does not open the service at the start | hint: The program runs, but a service is missing
replace("        self.open()\n        rospy.Service", "        rospy.Service")
# %% 05.5 wrong: does not compare before it closes | hint: A second call of /maintenance with
based_on("uses global variables")
replace('        if service is None:\n            return False, "closed"\n', "")
# %% 05.5 wrong: does not compare the states | hint: /move_arm, although it already served /move_arm
replace("changed = request.data == (self.move_service is not None)", "changed = True")
# %% 05.5 wrong: does not store the new service | hint: /move_arm, although it already served /move_arm
based_on("uses global variables")
replace('service = rospy.Service("/move_arm", Trigger, move)\n    return', 'rospy.Service("/move_arm", Trigger, move)\n    return')
# %% 05.5 wrong: deletes only the reference to the service | hint: The service still exists. Store the
replace("        self.move_service.shutdown(\"maintenance\")\n", "")
# %% 05.5 wrong: unregisters the service only at the master | hint: The service is no longer
replace('self.move_service.shutdown("maintenance")', 'rospy.core.rosgraph.Master("/arm").unregisterService("/move_arm", self.move_service.uri)')
# %% 05.5 wrong: never creates the service again | hint: Create this service again when
replace("            self.open()\n", "            self.move_service = self\n")
# %% 05.5 wrong: starts the count again at 1 | hint: After the maintenance, the count starts
replace("    def open(self):", "    def open(self):\n        self.moves = 0")
# %% 05.5 wrong: starts the count at 0 | hint: The first move returned 0
replace("str(self.moves)", "str(self.moves - 1)")
# %% 05.5 wrong: never increases the count | hint: The count is 1 after every call
replace("self.moves += 1", "self.moves = 1")
# %% 05.5 wrong: always returns success=True | hint: The state did not change, but
replace("success=changed", "success=True")
# %% 05.5 wrong: always returns success=False | hint: The call changed the state, but
replace("success=changed", "success=False")
# %% 05.5 wrong: exchanges the messages | hint: The message has to be the
replace('"closed" if request.data else "open"', '"open" if request.data else "closed"')
# %% 05.5 wrong: returns None if the state does not change | hint: The handler of /maintenance returned None.
replace("        changed = request", "        if not request.data and self.move_service is not None:\n            return None\n        changed = request")
# %% 05.5 wrong: ends the node | hint: The program ended during the calls.
replace('self.move_service.shutdown("maintenance")', 'rospy.signal_shutdown("maintenance")')
# %% 05.5 wrong: returns success=False from /move_arm | hint: In a response of /move_arm, success is False
replace("TriggerResponse(success=True, message", "TriggerResponse(message")
# %% 05.5 wrong: counts calls of /maintenance | hint: The count is wrong. Add
replace("changed = request", "self.moves += 1\n        changed = request")
# %% 05.5 wrong: does not import a type | hint: An exception has ended the program
replace("SetBoolResponse, Trigger, TriggerResponse", "SetBoolResponse, TriggerResponse")
# %% 05.5 wrong: starts another program that offers /move_arm | hint: Another process provides the
"""%%writefile arm.py
#!/usr/bin/env python3
import pathlib
import subprocess
import sys

import rospy
from std_srvs.srv import SetBool, SetBoolResponse

COUNT = pathlib.Path("arm_moves.txt")
MOVER = '''
import os, pathlib, rospy
from std_srvs.srv import Trigger
parent = os.getppid()
count = pathlib.Path("arm_moves.txt")
def move(request):
    count.write_text(str(int(count.read_text()) + 1))
    return True, count.read_text()
rospy.init_node("mover")
rospy.Service("/move_arm", Trigger, move)
while os.getppid() == parent and not rospy.is_shutdown():
    rospy.rostime.wallsleep(0.2)
'''
mover = None


def handle_maintenance(request):
    global mover
    was_closed = mover is None
    if request.data and mover:
        mover.terminate()
        mover.wait()
        mover = None
    elif not request.data and not mover:
        mover = subprocess.Popen([sys.executable, "-c", MOVER])
        rospy.wait_for_service("/move_arm", timeout=10)
    return SetBoolResponse(success=request.data != was_closed, message="closed" if request.data else "open")


if __name__ == "__main__":
    rospy.init_node("arm")
    COUNT.write_text("0")
    mover = subprocess.Popen([sys.executable, "-c", MOVER])
    rospy.Service("/maintenance", SetBool, handle_maintenance)
    rospy.spin()
    if mover:
        mover.terminate()
"""

# %% 05.5 wrong: offers the services in the notebook | hint: Another process provides the
from pathlib import Path

Path("arm.py").write_text("""#!/usr/bin/env python3
import rospy

if __name__ == "__main__":
    rospy.init_node("arm")
    rospy.spin()
""")
handle = lambda request: (True, "1")
services = [rospy.Service("/move_arm", Trigger, handle), rospy.Service("/maintenance", SetBool, handle)]
