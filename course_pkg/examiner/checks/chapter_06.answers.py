"""What students answer in chapter 06; see answers.py for the form of this file."""

# %% before
import rospy

from course_pkg import join
from course_pkg.srv import geometry, geometryRequest

node = join("chapter_06")

# %% 06.1 right: positional arguments
def measure(service, length, width, height):
    response = rospy.ServiceProxy(service, geometry)(length, width, height)
    return response.area, response.volume

# %% 06.1 right: a request object, and a list
def measure(service, length, width, height):
    rospy.wait_for_service(service, timeout=2)
    ask = rospy.ServiceProxy(service, geometry)
    response = ask(geometryRequest(length=length, width=width, height=height))
    return [response.area, response.volume]

# %% 06.1 right: the bounded call
def measure(service, length, width, height):
    response = node.call(service, geometry, length=length, width=width, height=height, timeout=3)
    return response.area, response.volume

# %% 06.1 wrong: computes instead of asking | hint: The service was not asked
def measure(service, length, width, height):
    area = width * length
    return area, area * height

# %% 06.1 wrong: asks a fixed name | hint: The master knows no provider of this name
def measure(service, length, width, height):
    response = rospy.ServiceProxy("/getGeometry", geometry)(length, width, height)
    return response.area, response.volume

# %% 06.1 wrong: swaps length and width | hint: length and width are swapped
def measure(service, length, width, height):
    response = rospy.ServiceProxy(service, geometry)(width, length, height)
    return response.area, response.volume

# %% 06.1 wrong: leaves a keyword out | hint: A field that is left out is 0
def measure(service, length, width, height):
    response = rospy.ServiceProxy(service, geometry)(length=length, width=width)
    return response.area, response.volume

# %% 06.1 wrong: calls once for each value | hint: Ask once and keep the response
def measure(service, length, width, height):
    ask = rospy.ServiceProxy(service, geometry)
    return ask(length, width, height).area, ask(length, width, height).volume

# %% 06.1 wrong: prints | hint: to print a value is not to return it
def measure(service, length, width, height):
    response = rospy.ServiceProxy(service, geometry)(length, width, height)
    print(response.area, response.volume)

# %% 06.1 wrong: returns the response | hint: That is the whole response
def measure(service, length, width, height):
    return rospy.ServiceProxy(service, geometry)(length, width, height)

# %% 06.1 wrong: returns them the wrong way round | hint: The order is area, then volume
def measure(service, length, width, height):
    response = rospy.ServiceProxy(service, geometry)(length, width, height)
    return response.volume, response.area

# %% 06.1 wrong: waits for ever for another name | hint: give the wait a limit
def measure(service, length, width, height):
    rospy.wait_for_service("/geometry")
    response = rospy.ServiceProxy(service, geometry)(length, width, height)
    return response.area, response.volume
