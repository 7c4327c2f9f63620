"""What students answer in chapter 06; see answers.py for the form of this file."""

# %% before
import rospy
from course_pkg import join
from course_pkg.errors import CallTimeout
from course_pkg.srv import geometry, geometryRequest

node = join("chapter_06")

# %% 06.1 right: by position
def measure(service, length, width, height):
    response = rospy.ServiceProxy(service, geometry)(length, width, height)
    return response.area, response.volume

# %% 06.1 right: a request, after waiting
def measure(service, length, width, height):
    rospy.wait_for_service(service, timeout=2)
    proxy = rospy.ServiceProxy(service, geometry)
    answer = proxy(geometryRequest(length=length, width=width, height=height))
    return [answer.area, answer.volume]

# %% 06.1 wrong: computes it | hint: Make the proxy with the name
def measure(service, length, width, height):
    return length * width, length * width * height

# %% 06.1 wrong: leaves the height out | hint: is 0 without a word
def measure(service, length, width, height):
    response = rospy.ServiceProxy(service, geometry)(length=length, width=width)
    return response.area, response.volume

# %% 06.1 wrong: volume first | hint: the volume first
def measure(service, length, width, height):
    response = rospy.ServiceProxy(service, geometry)(length, width, height)
    return response.volume, response.area

# %% 06.1 wrong: the whole response | hint: the whole response
def measure(service, length, width, height):
    return rospy.ServiceProxy(service, geometry)(length, width, height)

# %% 06.1 wrong: calls twice | hint: Call once and keep the response
def measure(service, length, width, height):
    proxy = rospy.ServiceProxy(service, geometry)
    return proxy(length, width, height).area, proxy(length, width, height).volume

# %% 06.1 wrong: forgets to return | hint: without a return line
def measure(service, length, width, height):
    response = rospy.ServiceProxy(service, geometry)(length, width, height)
    print(response.area, response.volume)

# %% 06.1 wrong: looks into the request | hint: fields of the request
def measure(service, length, width, height):
    request = geometryRequest(length, width, height)
    rospy.ServiceProxy(service, geometry)(request)
    return request.length, request.width

# %% 06.2 right: try and except
def is_there(service, seconds):
    try:
        rospy.wait_for_service(service, timeout=seconds)
    except rospy.ROSException:
        return False
    return True

# %% 06.2 right: one return line
def is_there(service, seconds):
    found = True
    try:
        rospy.wait_for_service(service, seconds)
    except rospy.exceptions.ROSException:
        found = False
    return found

# %% 06.2 wrong: no limit | hint: Give wait_for_service the limit
def is_there(service, seconds):
    try:
        rospy.wait_for_service(service)
    except rospy.ROSException:
        return False
    return True

# %% 06.2 wrong: catches the other exception | hint: Catch that one
def is_there(service, seconds):
    try:
        rospy.wait_for_service(service, timeout=seconds)
    except rospy.ServiceException:
        return False
    return True

# %% 06.2 wrong: takes None for an answer | hint: returns nothing when it succeeds
def is_there(service, seconds):
    try:
        return bool(rospy.wait_for_service(service, timeout=seconds))
    except rospy.ROSException:
        return False

# %% 06.2 wrong: looks once | hint: instead of looking once
def is_there(service, seconds):
    try:
        rospy.wait_for_service(service, timeout=0.1)
    except rospy.ROSException:
        return False
    return True

# %% 06.2 wrong: says nothing when it is not there | hint: Return False there
def is_there(service, seconds):
    try:
        rospy.wait_for_service(service, timeout=seconds)
        return True
    except rospy.ROSException:
        print("not there")

# %% 06.3 right: ServiceException
def volume_or_none(service, length, width, height):
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except rospy.ServiceException:
        return None

# %% 06.3 right: both of the course's and rospy's
def volume_or_none(service, length, width, height):
    request = geometryRequest(length, width, height)
    try:
        response = node.call(service, geometry, request, timeout=3)
    except (rospy.ServiceException, CallTimeout) as error:
        rospy.logwarn("no volume: %s", error)
        return None
    return response.volume

# %% 06.3 wrong: catches everything | hint: nothing wider
def volume_or_none(service, length, width, height):
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except Exception:
        return None

# %% 06.3 wrong: catches the other exception | hint: no rospy.ROSException
def volume_or_none(service, length, width, height):
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except rospy.ROSException:
        return None

# %% 06.3 wrong: catches nothing | hint: A call that fails raises
def volume_or_none(service, length, width, height):
    return rospy.ServiceProxy(service, geometry)(length, width, height).volume

# %% 06.3 wrong: a volume that says nothing | hint: tell it from a volume
def volume_or_none(service, length, width, height):
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except rospy.ServiceException:
        return 0.0

# %% 06.3 wrong: returns only after a failure | hint: None was returned
def volume_or_none(service, length, width, height):
    try:
        rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except rospy.ServiceException:
        return None

# %% 06.4 right: continue in a loop
def first_answer(services, length, width, height):
    for service in services:
        try:
            return node.call(service, geometry, length, width, height, timeout=1).volume
        except (rospy.ServiceException, CallTimeout):
            continue
    return None

# %% 06.4 right: from the end
def first_answer(services, length, width, height):
    if not services:
        return None
    try:
        return node.call(services[0], geometry, length, width, height, timeout=1).volume
    except (CallTimeout, rospy.ServiceException):
        return first_answer(services[1:], length, width, height)

# %% 06.4 wrong: no limit | hint: Give the call a limit
def first_answer(services, length, width, height):
    for service in services:
        try:
            return rospy.ServiceProxy(service, geometry)(length, width, height).volume
        except rospy.ServiceException:
            continue
    return None

# %% 06.4 wrong: lets the limit end the search | hint: Catch it, too
def first_answer(services, length, width, height):
    for service in services:
        try:
            return node.call(service, geometry, length, width, height, timeout=1).volume
        except rospy.ServiceException:
            continue
    return None

# %% 06.4 wrong: gives up after the first | hint: inside the loop
def first_answer(services, length, width, height):
    try:
        for service in services:
            return node.call(service, geometry, length, width, height, timeout=1).volume
    except (rospy.ServiceException, CallTimeout):
        return None

# %% 06.4 wrong: takes the last answer | hint: Stop at the first
def first_answer(services, length, width, height):
    volume = None
    for service in services:
        try:
            volume = node.call(service, geometry, length, width, height, timeout=1).volume
        except (rospy.ServiceException, CallTimeout):
            pass
    return volume

# %% 06.4 wrong: catches nothing | hint: must not end the search
def first_answer(services, length, width, height):
    for service in services:
        volume = node.call(service, geometry, length, width, height, timeout=1).volume
        if volume:
            return volume

# %% 06.5 right: myargv and float
def read_sides(argv):
    try:
        sides = [float(text) for text in rospy.myargv(argv)[1:]]
    except ValueError:
        return None
    return sides if len(sides) == 3 else None

# %% 06.5 right: unpacks them
def read_sides(argv):
    try:
        _, length, width, height = rospy.myargv(argv=argv)
        return float(length), float(width), float(height)
    except ValueError:
        return None

# %% 06.5 wrong: forgets what belongs to ROS | hint: rospy.myargv
def read_sides(argv):
    try:
        sides = [float(text) for text in argv[1:]]
    except ValueError:
        return None
    return sides if len(sides) == 3 else None

# %% 06.5 wrong: counts the program's name | hint: The sides start at the second
def read_sides(argv):
    try:
        sides = [float(text) for text in rospy.myargv(argv)]
    except ValueError:
        return None
    return sides if len(sides) == 3 else None

# %% 06.5 wrong: texts | hint: Make a float of each
def read_sides(argv):
    sides = rospy.myargv(argv)[1:]
    return sides if len(sides) == 3 else None

# %% 06.5 wrong: leaves a fourth one out | hint: one too many
def read_sides(argv):
    try:
        length, width, height = [float(text) for text in rospy.myargv(argv)[1:4]]
    except ValueError:
        return None
    return length, width, height

# %% 06.5 wrong: lets the error out | hint: raises ValueError
def read_sides(argv):
    sides = [float(text) for text in rospy.myargv(argv)[1:]]
    return sides if len(sides) == 3 else None
