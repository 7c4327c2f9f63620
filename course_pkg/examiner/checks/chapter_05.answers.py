"""What students answer in chapter 05; see answers.py for the form of this file."""

# %% before
import rospy
from course_pkg import join
from course_pkg.srv import geometry, geometryResponse
from std_srvs.srv import Empty, EmptyResponse, SetBool, SetBoolResponse, Trigger, TriggerResponse

node = join("chapter_05")
services = {}

# %% 05.1 after
node.serve("/getGeometry", geometry, handle_geometry)

# %% 05.1 right: a response object
def handle_geometry(request):
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.1 right: a tuple
def handle_geometry(request):
    return request.length * request.width, request.length * request.width * request.height

# %% 05.1 right: a response that is filled in later
def handle_geometry(request):
    response = geometryResponse()
    response.area = request.width * request.length
    response.volume = response.area * request.height
    return response

# %% 05.1 wrong: adds instead of multiplying | hint: width + length
def handle_geometry(request):
    area = request.width + request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.1 wrong: takes the front for the floor | hint: the front of the box
def handle_geometry(request):
    area = request.width * request.height
    return geometryResponse(area=area, volume=area * request.length)

# %% 05.1 wrong: volume first | hint: area first, then volume
def handle_geometry(request):
    area = request.width * request.length
    return area * request.height, area

# %% 05.1 wrong: forgets the volume | hint: The volume is 0
def handle_geometry(request):
    return geometryResponse(area=request.width * request.length)

# %% 05.1 wrong: forgets to return | hint: None
def handle_geometry(request):
    response = geometryResponse()
    response.area = request.width * request.length
    response.volume = response.area * request.height

# %% 05.1 wrong: adds the height | hint: area + height
def handle_geometry(request):
    area = request.width * request.length
    return geometryResponse(area=area, volume=area + request.height)

# %% 05.1 wrong: rounds | hint: It is rounded
def handle_geometry(request):
    return round(request.width * request.length), round(request.width * request.length * request.height)

# %% 05.1 wrong: all six sides | hint: The floor of the box is meant
def handle_geometry(request):
    l, w, h = request.length, request.width, request.height
    return geometryResponse(area=2 * (l * w + l * h + w * h), volume=l * w * h)

# %% 05.2 after
counter = Counter()
node.serve("/count", Trigger, counter.handle_count)
node.serve("/reset_count", Empty, counter.handle_reset)

# %% 05.2 right: a class that counts
class Counter:
    def __init__(self):
        self.count = 0

    def handle_count(self, request):
        self.count += 1
        return TriggerResponse(success=True, message=str(self.count))

    def handle_reset(self, request):
        self.count = 0
        return EmptyResponse()

# %% 05.2 right: the shortest legal forms
class Counter:
    count = 0

    def handle_count(self, request):
        self.count = self.count + 1
        return True, f"{self.count}"

    def handle_reset(self, request):
        self.count = 0
        return []

# %% 05.2 wrong: the reset returns nothing | hint: Even an empty response
class Counter:
    def __init__(self):
        self.count = 0

    def handle_count(self, request):
        self.count += 1
        return TriggerResponse(success=True, message=str(self.count))

    def handle_reset(self, request):
        self.count = 0

# %% 05.2 wrong: answers before it counts | hint: add one first
class Counter:
    def __init__(self):
        self.count = 0

    def handle_count(self, request):
        before = self.count
        self.count += 1
        return TriggerResponse(success=True, message=str(before))

    def handle_reset(self, request):
        self.count = 0
        return EmptyResponse()

# %% 05.2 wrong: a number where a text belongs | hint: str
class Counter:
    def __init__(self):
        self.count = 0

    def handle_count(self, request):
        self.count += 1
        return TriggerResponse(success=True, message=self.count)

    def handle_reset(self, request):
        self.count = 0
        return EmptyResponse()

# %% 05.2 wrong: the reset is forgotten | hint: went on from the old count
class Counter:
    def __init__(self):
        self.count = 7

    def handle_count(self, request):
        self.count += 1
        return TriggerResponse(success=True, message=str(self.count))

    def handle_reset(self, request):
        return EmptyResponse()

# %% 05.2 wrong: counts in a local variable | hint: keep the count in self
class Counter:
    def handle_count(self, request):
        count = 0
        count += 1
        return TriggerResponse(success=True, message=str(count))

    def handle_reset(self, request):
        return EmptyResponse()

# %% 05.2 wrong: leaves success out | hint: as a field is that is left out
class Counter:
    def __init__(self):
        self.count = 0

    def handle_count(self, request):
        self.count += 1
        return TriggerResponse(message=str(self.count))

    def handle_reset(self, request):
        self.count = 0
        return EmptyResponse()

# %% 05.2 wrong: wraps at 9 | hint: After 9 comes 10
class Counter:
    def __init__(self):
        self.count = 0

    def handle_count(self, request):
        self.count = self.count % 9 + 1
        return TriggerResponse(success=True, message=str(self.count))

    def handle_reset(self, request):
        self.count = 0
        return EmptyResponse()

# %% 05.2 wrong: says one digit only | hint: with both of its digits
class Counter:
    def __init__(self):
        self.count = 0

    def handle_count(self, request):
        self.count += 1
        return TriggerResponse(success=True, message=str(self.count)[-1])

    def handle_reset(self, request):
        self.count = 0
        return EmptyResponse()

# %% 05.2 wrong: says more than the number | hint: and nothing else
class Counter:
    def __init__(self):
        self.count = 0

    def handle_count(self, request):
        self.count += 1
        return TriggerResponse(success=True, message=f"{self.count} calls")

    def handle_reset(self, request):
        self.count = 0
        return EmptyResponse()

# %% 05.2 wrong: two digits | hint: No zero stands in front
class Counter:
    def __init__(self):
        self.count = 0
    def handle_count(self, request):
        self.count += 1
        return TriggerResponse(success=True, message=f"{self.count:02d}")
    def handle_reset(self, request):
        self.count = 0
        return EmptyResponse()

# %% 05.2 wrong: the number itself | hint: The message is a text
class Counter:
    def __init__(self):
        self.count = 0
    def handle_count(self, request):
        self.count += 1
        return TriggerResponse(success=True, message=self.count)
    def handle_reset(self, request):
        self.count = 0
        return EmptyResponse()

# %% 05.3 after
node.serve("/getGeometryChecked", geometry, handle_checked_geometry)

# %% 05.3 right: a loop over the sides
def handle_checked_geometry(request):
    for side in ("length", "width", "height"):
        value = getattr(request, side)
        if value < 0:
            raise rospy.ServiceException(f"{side} is {value}, and a side cannot be negative")
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 right: one question after the other
def handle_checked_geometry(request):
    if request.length < 0:
        raise rospy.ServiceException("negative length: %g" % request.length)
    if request.width < 0:
        raise rospy.ServiceException("negative width: %g" % request.width)
    if request.height < 0:
        raise rospy.ServiceException("negative height: %g" % request.height)
    return [request.length * request.width, request.length * request.width * request.height]

# %% 05.3 right: with a capital, and from the first that is found
def handle_checked_geometry(request):
    sides = {"Length": request.length, "Width": request.width, "Height": request.height}
    negative = [f"{name} is {value:.2f} m" for name, value in sides.items() if value < 0]
    if negative:
        raise rospy.ServiceException(negative[0])
    return request.length * request.width, request.length * request.width * request.height

# %% 05.3 wrong: measures it all the same | hint: measured like any other
def handle_checked_geometry(request):
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: raises a ValueError | hint: Only rospy.ServiceException
def handle_checked_geometry(request):
    for side in ("length", "width", "height"):
        if getattr(request, side) < 0:
            raise ValueError(f"{side} is {getattr(request, side)}")
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: returns None | hint: words of your own
def handle_checked_geometry(request):
    if min(request.length, request.width, request.height) < 0:
        return None
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: says that something is wrong, but not what | hint: Name it, and say its value
def handle_checked_geometry(request):
    if min(request.length, request.width, request.height) < 0:
        raise rospy.ServiceException("no such box")
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: answers with an empty box | hint: measured like any other
def handle_checked_geometry(request):
    if min(request.length, request.width, request.height) < 0:
        return geometryResponse()
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: refuses a flat box, too | hint: Zero is fine
def handle_checked_geometry(request):
    for side in ("length", "width", "height"):
        if getattr(request, side) <= 0:
            raise rospy.ServiceException(f"{side} is {getattr(request, side)}")
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: returns the exception | hint: raise it: raise rospy.ServiceException
def handle_checked_geometry(request):
    for side in ("length", "width", "height"):
        value = getattr(request, side)
        if value < 0:
            return rospy.ServiceException(f"{side} is {value}")
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: returns the words | hint: Do not return the refusal
def handle_checked_geometry(request):
    for side in ("length", "width", "height"):
        value = getattr(request, side)
        if value < 0:
            return f"{side} is {value}"
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: compares without the fraction | hint: as it came: -0.5 is negative
def handle_checked_geometry(request):
    for side in ("length", "width", "height"):
        value = getattr(request, side)
        if int(value) < 0:
            raise rospy.ServiceException(f"{side} is {value}")
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: names the side, and not its value | hint: Say its value, too
def handle_checked_geometry(request):
    for side in ("length", "width", "height"):
        value = getattr(request, side)
        if value < 0:
            raise rospy.ServiceException(f"{side} is negative")
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: sends the whole request back | hint: and no other
def handle_checked_geometry(request):
    for side in ("length", "width", "height"):
        value = getattr(request, side)
        if value < 0:
            raise rospy.ServiceException(f"a negative side in {request}")
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: names all sides | hint: and no other
def handle_checked_geometry(request):
    sides = request.length, request.width, request.height
    if min(sides) < 0:
        raise rospy.ServiceException("length, width, height: %s, %s, %s" % sides)
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: names the last negative side | hint: the first negative side
def handle_checked_geometry(request):
    for side in ("height", "width", "length"):
        if getattr(request, side) < 0:
            raise rospy.ServiceException(f"{side} is {getattr(request, side)}")
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: refuses a box without length | hint: Zero is fine
def handle_checked_geometry(request):
    for side in ("length", "width", "height"):
        value = getattr(request, side)
        if value < 0 or not request.length:
            raise rospy.ServiceException(f"{side} is {value}")
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.3 wrong: forgets the width | hint: measured like any other
def handle_checked_geometry(request):
    for side in ("length", "height"):
        if getattr(request, side) < 0:
            raise rospy.ServiceException(f"{side} is {getattr(request, side)}")
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.4 after
switch = Switch()
node.serve("/switch", SetBool, switch.handle_switch)

# %% 05.4 right: compares first
class Switch:
    def __init__(self):
        self.on = False

    def handle_switch(self, request):
        moved = request.data != self.on
        self.on = request.data
        return SetBoolResponse(success=moved, message="on" if self.on else "off")

# %% 05.4 right: leaves early
class Switch:
    state = "off"

    def handle_switch(self, request):
        wanted = {True: "on", False: "off"}[request.data]
        if wanted == self.state:
            return {"success": False, "message": self.state}
        self.state = wanted
        return {"success": True, "message": wanted}

# %% 05.4 wrong: always says that it moved | hint: It was already there
class Switch:
    def __init__(self):
        self.on = False

    def handle_switch(self, request):
        self.on = request.data
        return SetBoolResponse(success=True, message="on" if self.on else "off")

# %% 05.4 wrong: turns first and compares then | hint: It did move
class Switch:
    def __init__(self):
        self.on = False

    def handle_switch(self, request):
        self.on = request.data
        return SetBoolResponse(success=request.data != self.on, message="on" if self.on else "off")

# %% 05.4 wrong: says where it stood before | hint: where it stood before
class Switch:
    def __init__(self):
        self.on = False

    def handle_switch(self, request):
        message = "on" if self.on else "off"
        moved = request.data != self.on
        self.on = request.data
        return SetBoolResponse(success=moved, message=message)

# %% 05.4 wrong: says True and False | hint: the word on or the word off
class Switch:
    def __init__(self):
        self.on = False

    def handle_switch(self, request):
        moved = request.data != self.on
        self.on = request.data
        return SetBoolResponse(success=moved, message=str(self.on))

# %% 05.4 wrong: takes True for off | hint: True means on
class Switch:
    def __init__(self):
        self.on = False

    def handle_switch(self, request):
        self.on = not request.data
        return SetBoolResponse(success=True, message="on" if self.on else "off")

# %% 05.4 wrong: turns the other way each time | hint: data is where to go
class Switch:
    def __init__(self):
        self.on = False

    def handle_switch(self, request):
        self.on = not self.on
        return SetBoolResponse(success=True, message="on" if self.on else "off")

# %% 05.4 wrong: starts on | hint: start with False
class Switch:
    def __init__(self):
        self.on = True

    def handle_switch(self, request):
        moved = request.data != self.on
        self.on = request.data
        return SetBoolResponse(success=moved, message="on" if self.on else "off")

# %% 05.4 wrong: starts nowhere | hint: start with False
class Switch:
    def __init__(self):
        self.on = None

    def handle_switch(self, request):
        moved = request.data != self.on
        self.on = request.data
        return SetBoolResponse(success=moved, message="on" if self.on else "off")

# %% 05.4 wrong: in a sentence | hint: and nothing else
class Switch:
    def __init__(self):
        self.on = False

    def handle_switch(self, request):
        moved = request.data != self.on
        self.on = request.data
        return SetBoolResponse(success=moved, message="It is on" if self.on else "It is off")

# %% 05.4 wrong: one value for all switches | hint: they share one value
class Switch:
    on = False

    def handle_switch(self, request):
        moved = request.data != Switch.on
        Switch.on = request.data
        return SetBoolResponse(success=moved, message="on" if Switch.on else "off")

# %% 05.4 wrong: refuses to stay | hint: that is no error
class Switch:
    def __init__(self):
        self.on = False
    def handle_switch(self, request):
        if request.data == self.on:
            raise rospy.ServiceException("already there")
        self.on = request.data
        return SetBoolResponse(success=True, message="on" if self.on else "off")

# %% 05.5 right: keeps it in the dict
def open_service(name):
    services[name] = rospy.Service(name, Trigger, lambda request: (True, "open"))


def close_service(name):
    services.pop(name).shutdown("closed")

# %% 05.5 right: with the course's serve
def answer(request):
    return TriggerResponse(success=True, message="open")


def open_service(name):
    services[name] = node.serve(name, Trigger, answer)


def close_service(name):
    services[name].stop()

# %% 05.5 wrong: deletes the reference | hint: reference of its own
def open_service(name):
    services[name] = rospy.Service(name, Trigger, lambda request: (True, "open"))


def close_service(name):
    del services[name]

# %% 05.5 wrong: names shutdown but does not call it | hint: Call its shutdown()
def open_service(name):
    services[name] = rospy.Service(name, Trigger, lambda request: (True, "open"))


def close_service(name):
    services[name].shutdown

# %% 05.5 wrong: shuts everything down | hint: Shut down the one service
def open_service(name):
    services[name] = rospy.Service(name, Trigger, lambda request: (True, "open"))


def close_service(name):
    for service in services.values():
        service.shutdown("closed")

# %% 05.5 wrong: keeps only the last one | hint: under its name, and look
def open_service(name):
    global service
    service = rospy.Service(name, Trigger, lambda request: (True, "open"))


def close_service(name):
    service.shutdown("closed")

# %% 05.5 wrong: serves one name only | hint: the name that it is given
def open_service(name):
    services[name] = node.serve("/temporary", Trigger, lambda request: (True, "open"))


def close_service(name):
    services[name].stop()

# %% 05.5 right: asks before it opens
def open_service(name):
    if name not in services:
        services[name] = rospy.Service(name, Trigger, lambda request: (True, "open"))


def close_service(name):
    services[name].shutdown("closed")
    del services[name]

# %% 05.5 wrong: tells the master only | hint: the node still serves it
import rosgraph


def open_service(name):
    services[name] = rospy.Service(name, Trigger, lambda request: (True, "open"))


def close_service(name):
    rosgraph.Master(rospy.get_name()).unregisterService(name, services[name].uri)

# %% 05.5 wrong: closes the oldest | hint: Another one was closed
def open_service(name):
    services[name] = rospy.Service(name, Trigger, lambda request: (True, "open"))


def close_service(name):
    services.pop(min(services, key=list(services).index)).shutdown("closed")

# %% 05.5 wrong: closes another one, too | hint: Another one was closed with it
def open_service(name):
    services[name] = rospy.Service(name, Trigger, lambda request: (True, "open"))


def close_service(name):
    services.pop(name).shutdown("closed")
    services.popitem()[1].shutdown("closed")

# %% 05.5 wrong: never opens a name again | hint: is it still in
def open_service(name):
    if name not in services:
        services[name] = rospy.Service(name, Trigger, lambda request: (True, "open"))


def close_service(name):
    services[name].shutdown("closed")

# %% 05.5 wrong: says closed | hint: and nothing else
def open_service(name):
    services[name] = rospy.Service(name, Trigger, lambda request: (True, ""))
def close_service(name):
    services.pop(name).shutdown()
