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

# %% 06.1 wrong: rounds them | hint: unchanged
def measure(service, length, width, height):
    response = rospy.ServiceProxy(service, geometry)(length, width, height)
    return round(response.area), round(response.volume)

# %% 06.1 wrong: the volume alone | hint: with a comma between them
def measure(service, length, width, height):
    return rospy.ServiceProxy(service, geometry)(length, width, height).volume

# %% 06.1 wrong: one server | hint: The service that was named is there
def measure(service, length, width, height):
    r = rospy.ServiceProxy("/getGeometry", geometry)(length, width, height)
    return r.area, r.volume

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

# %% 06.2 wrong: guesses by the time it has | hint: half a second is enough to see it
def is_there(service, seconds):
    if seconds < 1:
        rospy.sleep(seconds)
    return seconds > 1

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

# %% 06.2 wrong: looks once | hint: as long as `seconds` says
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

# %% 06.2 wrong: a limit of its own | hint: It waited longer than it was told to
def is_there(service, seconds):
    try:
        rospy.wait_for_service(service, timeout=2)
    except rospy.ROSException:
        return False
    return True

# %% 06.2 wrong: three times the limit | hint: Give wait_for_service the limit
def is_there(service, seconds):
    for _ in range(3):
        try:
            rospy.wait_for_service(service, timeout=seconds)
            return True
        except rospy.ROSException:
            continue
    return False

# %% 06.2 wrong: always waits to the end | hint: Return as soon as it is there
import rosservice


def is_there(service, seconds):
    rospy.sleep(seconds)
    return service in rosservice.get_service_list()

# %% 06.2 wrong: believes the master | hint: its process is gone
import time

import rosservice


def is_there(service, seconds):
    end = time.time() + seconds
    while time.time() < end:
        if service in rosservice.get_service_list():
            return True
        time.sleep(0.1)
    return False

# %% 06.2 right: any exception
def is_there(service, seconds):
    try:
        rospy.wait_for_service(service, seconds)
        return True
    except Exception:
        return False

# %% 06.2 wrong: catches whatever comes | hint: A bare except: catches the Stop button
def is_there(service, seconds):
    try:
        rospy.wait_for_service(service, seconds)
        return True
    except:
        return False

# %% 06.2 wrong: a text | hint: That is a text
def is_there(service, seconds):
    try:
        rospy.wait_for_service(service, seconds)
        return "True"
    except rospy.ROSException:
        return "False"

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

# %% 06.3 right: waits first
def volume_or_none(service, length, width, height):
    try:
        rospy.wait_for_service(service, timeout=1)
    except rospy.ROSException:
        return None
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except rospy.ServiceException:
        return None

# %% 06.3 wrong: waits first, and forgets that it may be in vain | hint: Catch it there
def volume_or_none(service, length, width, height):
    rospy.wait_for_service(service, timeout=0.5)
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except rospy.ServiceException:
        return None

# %% 06.3 wrong: takes 0 for nothing | hint: An answer of 0.0 is a volume
def volume_or_none(service, length, width, height):
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume or None
    except rospy.ServiceException:
        return None

# %% 06.3 wrong: tries again | hint: Give up after one
def volume_or_none(service, length, width, height):
    for _ in range(2):
        try:
            return rospy.ServiceProxy(service, geometry)(length, width, height).volume
        except rospy.ServiceException:
            continue
    return None

# %% 06.3 wrong: catches a number that is too large, too | hint: Nobody hears of a wrong argument
def volume_or_none(service, length, width, height):
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except (rospy.ServiceException, ArithmeticError, LookupError, TypeError, ValueError):
        return None

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

# %% 06.3 wrong: returns only after a failure | hint: The server answered, and None was returned
def volume_or_none(service, length, width, height):
    try:
        rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except rospy.ServiceException:
        return None

# %% 06.3 right: checks the numbers first
def volume_or_none(service, length, width, height):
    for side in (length, width, height):
        if not isinstance(side, (int, float)):
            raise TypeError(f"{side!r} is no number")
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except rospy.ServiceException:
        return None

# %% 06.3 wrong: a TypeError, too | hint: nothing wider
def volume_or_none(service, length, width, height):
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except (rospy.ServiceException, TypeError):
        return None

# %% 06.3 wrong: an AttributeError, too | hint: nothing wider
def volume_or_none(service, length, width, height):
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except (rospy.ServiceException, AttributeError):
        return None

# %% 06.3 wrong: the text of the error | hint: Return None itself
def volume_or_none(service, length, width, height):
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except rospy.ServiceException as error:
        return str(error)

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

# %% 06.4 right: waits for each first
def first_answer(services, length, width, height):
    for service in services:
        try:
            rospy.wait_for_service(service, timeout=0.5)
            return node.call(service, geometry, length, width, height, timeout=1).volume
        except (rospy.ROSException, rospy.ServiceException, CallTimeout) as error:
            rospy.logdebug(error)

# %% 06.4 wrong: two seconds | hint: The limit is one second
def first_answer(services, length, width, height):
    for service in services:
        try:
            return node.call(service, geometry, length, width, height, timeout=2).volume
        except (rospy.ServiceException, CallTimeout):
            continue
    return None

# %% 06.4 wrong: no patience | hint: has a whole second
def first_answer(services, length, width, height):
    for service in services:
        try:
            return node.call(service, geometry, length, width, height, timeout=0.1).volume
        except (rospy.ServiceException, CallTimeout):
            continue
    return None

# %% 06.4 wrong: asks two only | hint: go through all
def first_answer(services, length, width, height):
    for service in services[:2]:
        try:
            return node.call(service, geometry, length, width, height, timeout=1).volume
        except (rospy.ServiceException, CallTimeout):
            continue
    return None

# %% 06.4 wrong: takes 0 for no answer | hint: but it is a volume
def first_answer(services, length, width, height):
    for service in services:
        try:
            volume = node.call(service, geometry, length, width, height, timeout=1).volume
        except (rospy.ServiceException, CallTimeout):
            continue
        if volume:
            return volume
    return None

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
        if volume is not None:
            return volume

# %% 06.4 right: threads of its own
import threading
def first_answer(services, length, width, height):
    for service in services:
        box = []
        def ask():
            try:
                box.append(rospy.ServiceProxy(service, geometry)(length, width, height).volume)
            except rospy.ServiceException:
                pass
        thread = threading.Thread(target=ask, daemon=True)
        thread.start()
        thread.join(1.0)
        if box:
            return box[0]
    return None

# %% 06.4 wrong: catches whatever comes | hint: A bare except: catches the Stop button
def first_answer(services, length, width, height):
    for service in services:
        try:
            return node.call(service, geometry, length, width, height, timeout=1).volume
        except:
            pass
    return None

# %% 06.4 wrong: the response | hint: That is the whole response
def first_answer(services, length, width, height):
    for service in services:
        try:
            return node.call(service, geometry, length, width, height, timeout=1)
        except (rospy.ServiceException, CallTimeout):
            pass

# %% 06.4 wrong: an error at the end | hint: return None after the loop
def first_answer(services, length, width, height):
    for service in services:
        try:
            return node.call(service, geometry, length, width, height, timeout=1).volume
        except (rospy.ServiceException, CallTimeout) as error:
            last = error
    raise last

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

# %% 06.5 wrong: digits and a point only | hint: -1.5 is a number
def read_sides(argv):
    sides = [float(text) for text in rospy.myargv(argv)[1:] if text.replace(".", "", 1).isdigit()]
    return sides if len(sides) == 3 else None

# %% 06.5 wrong: digits only | hint: a number may have a point
def read_sides(argv):
    sides = [float(text) for text in rospy.myargv(argv)[1:] if text.isdigit()]
    return sides if len(sides) == 3 else None

# %% 06.5 wrong: drops the sign | hint: return it as it is
def read_sides(argv):
    try:
        sides = [abs(float(text)) for text in rospy.myargv(argv)[1:]]
    except ValueError:
        return None
    return sides if len(sides) == 3 else None

# %% 06.5 wrong: leaves a word out | hint: nothing to leave out
def read_sides(argv):
    sides = []
    for text in rospy.myargv(argv)[1:]:
        try:
            sides.append(float(text))
        except ValueError:
            continue
    return sides if len(sides) == 3 else None

# %% 06.5 wrong: ends the program | hint: It ends the program
import sys
def read_sides(argv):
    own = rospy.myargv(argv)[1:]
    if len(own) != 3:
        sys.exit("usage: client length width height")
    return [float(text) for text in own]

# %% 06.5 wrong: the arguments of this program | hint: rospy.myargv(argv)
def read_sides(argv):
    try:
        sides = [float(text) for text in rospy.myargv()[1:]]
    except ValueError:
        return None
    return sides if len(sides) == 3 else None
