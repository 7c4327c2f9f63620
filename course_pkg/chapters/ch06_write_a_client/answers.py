"""Example answers of chapter 06; tests/checking/answers/example_answers.py explains the format."""

# %% 06.1 right: passes the sides by position
def measure(service, length, width, height):
    response = rospy.ServiceProxy(service, geometry)(length, width, height)
    return response.area, response.volume

# %% 06.1 right: waits, and passes a request object
def measure(service, length, width, height):
    rospy.wait_for_service(service, timeout=2)
    proxy = rospy.ServiceProxy(service, geometry)
    answer = proxy(geometryRequest(length=length, width=width, height=height))
    return [answer.area, answer.volume]

# %% 06.1 wrong: calculates the results without a call | hint: The given service was not
def measure(service, length, width, height):
    return length * width, length * width * height

# %% 06.1 wrong: omits the height | hint: A side in the request is 0
replace("(length, width, height)", "(length=length, width=width)")
# %% 06.1 wrong: returns the volume first | hint: The order of the results
replace("area, response.volume", "volume, response.area")

# %% 06.1 wrong: returns the whole response | hint: Return only the fields `area`
def measure(service, length, width, height):
    return rospy.ServiceProxy(service, geometry)(length, width, height)

# %% 06.1 wrong: calls the service twice | hint: more than once, so the server did the work again
def measure(service, length, width, height):
    proxy = rospy.ServiceProxy(service, geometry)
    return proxy(length, width, height).area, proxy(length, width, height).volume

# %% 06.1 wrong: stores the responses | hint: The check called measure() twice
responses = {}

def measure(*question):
    if question not in responses:
        service, *sides = question
        responses[question] = rospy.ServiceProxy(service, geometry)(*sides)
    return responses[question].area, responses[question].volume

# %% 06.1 wrong: forgets to return | hint: without a return statement
replace("return response.area, response.volume", "print(response.area, response.volume)")

# %% 06.1 wrong: reads the fields of the request | hint: The function returned fields of
def measure(service, length, width, height):
    request = geometryRequest(length, width, height)
    rospy.ServiceProxy(service, geometry)(request)
    return request.length, request.width

# %% 06.1 wrong: rounds area and volume | hint: Return the area and the volume of
replace("response.area, response.volume", "round(response.area), round(response.volume)")
# %% 06.1 wrong: rounds to three decimals | hint: Return the area and the volume of
replace("response.area, response.volume", "round(response.area, 3), round(response.volume, 3)")
# %% 06.1 wrong: sends the sides in whole millimetres | hint: without rounding them
replace("(length, width, height)\n    return", "(*[round(side, 3) for side in (length, width, height)])\n    return")
# %% 06.1 wrong: returns only the volume | hint: Return the area and the volume, with a comma
based_on("returns the whole response")
replace("(length, width, height)", "(length, width, height).volume")

# %% 06.1 wrong: repeats a refused call | hint: and the function called the server again
def measure(service, length, width, height):
    proxy = rospy.ServiceProxy(service, geometry)
    try:
        response = proxy(length, width, height)
    except rospy.ServiceException:
        response = proxy(length, width, height)
    return response.area, response.volume

# %% 06.1 wrong: sends other sides in every second call | hint: Send the three arguments in every call
replace("height):", "height, calls=[]):\n    calls.append(service)\n    length = length if len(calls) % 2 else 1.0")

# %% 06.1 wrong: calls a fixed service | hint: The given service exists, but your
replace("response = rospy.ServiceProxy(service, geometry)", 'r = rospy.ServiceProxy("/getGeometry", geometry)')
replace("response.area, response", "r.area, r")
# %% 06.1 wrong: passes the width first | hint: The server received the sides in
replace("(length, width, height)\n", "(width, length, height)\n")

# %% 06.2 right: uses try and except
def is_there(service, seconds):
    try:
        rospy.wait_for_service(service, timeout=seconds)
    except rospy.ROSException:
        return False
    return True

# %% 06.2 wrong: decides by the elapsed time | hint: The service exists, but the function returned
replace("try: … return True", "if seconds < 1:\n        rospy.sleep(seconds)\n    return seconds > 1")
# %% 06.2 wrong: looks only at the first five services | hint: With another service, the result was wrong.
replace("seconds):", "seconds, calls=[]):\n    calls.append(service)\n    if len(calls) > 5:\n        return True")
# %% 06.2 wrong: waits only for half of a short time limit | hint: The function returned False too early
replace("timeout=seconds", "timeout=seconds if seconds > 2 else seconds / 2")
# %% 06.2 wrong: calls the service, but only from the fifth time on | hint: but do not call the service
replace("seconds):", "seconds, calls=[]):\n    calls.append(service)")
replace("timeout=seconds)", "timeout=seconds)\n        if len(calls) > 5:\n            rospy.ServiceProxy(service, geometry)(1, 1, 1)")
# %% 06.2 wrong: stores the results | hint: the service started, but the result did not
replace("def is_there", "import functools\n\n\n@functools.lru_cache(maxsize=None)\ndef is_there")
# %% 06.2 wrong: waits without a limit | hint: The function waited longer than the time
replace("service, timeout=seconds", "service")
# %% 06.2 wrong: catches rospy.ServiceException | hint: Catch this exception.
replace("rospy.ROSException", "rospy.ServiceException")
# %% 06.2 wrong: uses the return value of wait_for_service | hint: The service exists, but the result was
replace("rospy.wait_for_service(service, timeout=seconds)", "return bool(rospy.wait_for_service(service, timeout=seconds))")
replace("\n    return True", "")
# %% 06.2 wrong: waits only for 0.1 s | hint: Wait for the service until
replace("timeout=seconds", "timeout=0.1")
# %% 06.2 wrong: returns None if there is no service | hint: When the time was over
replace("except rospy … return True", '    return True\n    except rospy.ROSException:\n        print("not there")')
# %% 06.2 wrong: removes the fraction from the time limit | hint: because it can be a fraction
replace("timeout=seconds", "timeout=int(seconds)")
# %% 06.2 wrong: uses a fixed time limit | hint: The function waited longer than the time
replace("timeout=seconds", "timeout=2")

# %% 06.2 wrong: always waits for the whole time | hint: The function waits although the service
import rosservice


def is_there(service, seconds):
    rospy.sleep(seconds)
    return service in rosservice.get_service_list()

# %% 06.2 wrong: checks only at the start and at the end | hint: but the function continued to wait
import rosservice

def is_there(service, seconds):
    def now():
        try:
            return rosservice.get_service_type(service) is not None
        except rosservice.ROSServiceIOException:
            return False

    if now():
        return True
    rospy.sleep(seconds)
    return now()

# %% 06.2 wrong: checks only the registration at the master | hint: The service is still registered
import time

import rosservice


def is_there(service, seconds):
    end = time.time() + seconds
    while time.time() < end:
        if service in rosservice.get_service_list():
            return True
        time.sleep(0.1)
    return False

# %% 06.2 right: catches Exception
replace("""rospy.wait_for_service(service, timeout=seconds)
    except rospy.ROSException:""", "rospy.wait_for_service(service, seconds)\n        return True\n    except Exception:")
replace("\n    return True", "")
# %% 06.2 wrong: uses except without a class | hint: catches the KeyboardInterrupt
based_on("catches Exception")
replace("except Exception:", "except:")
# %% 06.2 wrong: returns strings | hint: Write True and False without quotes
replace("return True", 'return "True"')
replace("return False", 'return "False"')
# %% 06.2 wrong: returns True in any case | hint: The function returned True for a
replace("return False", "pass")

# %% 06.2 wrong: calls the service | hint: but do not call the service
replace("timeout=seconds)", "timeout=seconds)\n        rospy.ServiceProxy(service, geometry)(1, 1, 1)")

# %% 06.3 right: catches rospy.ServiceException
def volume_or_none(service, length, width, height):
    try:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    except rospy.ServiceException:
        return None

# %% 06.3 right: waits for the service first
replace("(service, length, width, height):", """(service, length, width, height):
    try:
        rospy.wait_for_service(service, timeout=1)
    except rospy.ROSException:
        return None""")
# %% 06.3 wrong: waits first, and does not catch the timeout | hint: wait_for_service raises rospy.ROSException when the timeout
replace("    try:", "    rospy.wait_for_service(service, timeout=0.5)\n    try:")
# %% 06.3 wrong: uses only the first six responses | hint: Read the volume from the
replace("height):", "height, calls=[]):\n    calls.append(service)")
replace(".volume", ".volume if len(calls) < 7 else None")
# %% 06.3 wrong: returns None for a volume of 0 | hint: The server responded, but the function
replace(".volume", ".volume or None")

# %% 06.3 wrong: returns None for an invalid height | hint: The function catches the exception that a wrong
replace("    try:", "    if not isinstance(height, (int, float)):\n        return None\n    try:")
# %% 06.3 wrong: catches the KeyboardInterrupt | hint: The function catches the KeyboardInterrupt
replace("rospy.ServiceException", "(rospy.ServiceException, KeyboardInterrupt)")
# %% 06.3 wrong: calls again after a failure | hint: The function repeated a failed
def volume_or_none(service, length, width, height):
    for _ in range(2):
        try:
            return rospy.ServiceProxy(service, geometry)(length, width, height).volume
        except rospy.ServiceException:
            continue
    return None

# %% 06.3 wrong: also catches errors from numbers that are too large | hint: The function catches the exception that a wrong argument causes
replace("volume\n    except rospy.ServiceException:", """volume
    except (rospy.ServiceException, ArithmeticError, LookupError, TypeError, ValueError):""")
# %% 06.3 wrong: stores the results | hint: it returned the volume of the first response
stored = {}


def volume_or_none(service, *sides):
    key = (service, *map(repr, sides))
    if key not in stored:
        try:
            stored[key] = rospy.ServiceProxy(service, geometry)(*sides).volume
        except rospy.ServiceException:
            stored[key] = None
    return stored[key]

# %% 06.3 wrong: does not catch the error of a buggy handler | hint: In this case, too, the call raised
replace("    except rospy.ServiceException:", '    except rospy.ServiceException as error:\n        if "error processing" in str(error):\n            raise')
# %% 06.3 wrong: does not catch the error of another definition | hint: In this case, too, the call raised
replace("    except rospy.ServiceException:", '    except rospy.ServiceException as error:\n        if "md5sums" in str(error):\n            raise')
# %% 06.3 wrong: catches Exception | hint: The function catches the exception that a wrong argument causes
replace("rospy.ServiceException", "Exception")
# %% 06.3 wrong: catches rospy.ROSException | hint: not rospy.ROSException
replace("ServiceException", "ROSException")
# %% 06.3 wrong: catches no exception | hint: raises rospy.ServiceException, not
replace("try: … return None", "return rospy.ServiceProxy(service, geometry)(length, width, height).volume")
# %% 06.3 wrong: returns 0.0 instead of None | hint: The call failed, but the
replace("None", "0.0")
# %% 06.3 wrong: has a return line only for a failure | hint: the function returned None
replace("return rospy", "rospy")
# %% 06.3 right: checks the numbers first
replace("(service, length, width, height):", """(service, length, width, height):
    for side in (length, width, height):
        if not isinstance(side, (int, float)):
            raise TypeError(f"{side!r} is no number")""")
# %% 06.3 wrong: also catches TypeError | hint: The function catches the exception that a wrong argument causes
replace("rospy.ServiceException", "(rospy.ServiceException, TypeError)")
# %% 06.3 wrong: also catches AttributeError | hint: The function catches the exception that a wrong argument causes
replace("rospy.ServiceException", "(rospy.ServiceException, AttributeError)")
# %% 06.3 wrong: returns the exception | hint: The call failed, but the
replace(":\n        return None", " as error:\n        return error")
# %% 06.3 wrong: returns the error message | hint: The call failed, but the
replace(":\n        return None", " as error:\n        return str(error)")
# %% 06.3 wrong: returns the area | hint: Return the field `volume` of the
replace(".volume", ".area")

# %% 06.3 wrong: converts a string | hint: Do not convert the arguments
replace("(length, width, height).volume", "(float(length), width, height).volume")
# %% 06.3 wrong: calls the service with the command rosservice | hint: The function accepted a string as a number
import subprocess

import yaml


def volume_or_none(service, length, width, height):
    sides = [str(length), str(width), str(height)]
    called = subprocess.run(["rosservice", "call", service, "--", *sides], capture_output=True, text=True)
    if called.returncode != 0:
        return None
    return float(yaml.safe_load(called.stdout)["volume"])

# %% 06.3 wrong: calculates the volume without a call | hint: The function returned the product
replace("rospy.ServiceProxy(service, geometry)(length, width, height).volume", "length * width * height")
# %% 06.3 wrong: does not catch a refusal | hint: In this case, too, the call raised
replace("rospy.ServiceException:", 'rospy.ServiceException as error:\n        if "unavailable" not in str(error):\n            raise')
# %% 06.3 wrong: calls the service twice | hint: The function called the service more than once.
replace("        return rospy", "        rospy.ServiceProxy(service, geometry)(length, width, height)\n        return rospy")

# %% 06.4 right: uses a function for the thread
def first_answer(services, length, width, height):
    def ask_one(proxy, answers):
        try:
            answers.append(proxy(length, width, height).volume)
        except rospy.ServiceException:
            pass

    for service in services:
        answers = []
        proxy = rospy.ServiceProxy(service, geometry)
        asker = threading.Thread(target=ask_one, args=[proxy, answers], daemon=True)
        asker.start()
        asker.join(timeout=1)
        if answers:
            return answers[0]
    return None

# %% 06.4 wrong: calls the next service too early | hint: but the function had already called the second
import time


def first_answer(services, length, width, height):
    def ask(service, answers):
        try:
            answers.append(rospy.ServiceProxy(service, geometry)(length, width, height).volume)
        except rospy.ServiceException:
            pass

    calls = []
    for service in services:
        answers = []
        thread = threading.Thread(target=ask, args=[service, answers], daemon=True)
        thread.start()
        calls.append((thread, answers, time.monotonic() + 1))
        thread.join(0.3)
        if answers:
            break
    for thread, answers, end in calls:
        thread.join(max(0, end - time.monotonic()))
        if answers:
            return answers[0]
    return None

# %% 06.4 wrong: calls only in the first nine calls | hint: Call these services each time
replace("height):", "height, calls=[]):\n    calls.append(services)\n    if len(calls) > 9:\n        return None")
# %% 06.4 right: lets the error end the thread
def ask(proxy, sides, answers):
    answers.append(proxy(*sides))


def first_answer(services, length, width, height):
    for service in services:
        answers = []
        sides = (length, width, height)
        asker = threading.Thread(
            target=ask, args=[rospy.ServiceProxy(service, geometry), sides, answers], daemon=True
        )
        asker.start()
        asker.join(1.0)
        if answers:
            return answers[0].volume

# %% 06.4 right: uses a future
from concurrent.futures import ThreadPoolExecutor, TimeoutError as TooLate


def first_answer(services, length, width, height):
    for service in services:
        pool = ThreadPoolExecutor()
        future = pool.submit(rospy.ServiceProxy(service, geometry), length, width, height)
        try:
            return future.result(timeout=1).volume
        except (rospy.ServiceException, TooLate):
            pool.shutdown(wait=False)
    return None

# %% 06.4 wrong: waits two seconds for each service | hint: The function waits too long for one service
replace("timeout=1", "timeout=2")
# %% 06.4 wrong: waits 0.4 s for each service | hint: The first service responds after 0.6
replace("timeout=1", "timeout=0.4")
# %% 06.4 wrong: waits 0.8 s for each service | hint: Wait one full second for each service
replace("timeout=1", "timeout=0.8")
# %% 06.4 wrong: calls only two services | hint: try all services
replace("services:", "services[:2]:")
# %% 06.4 wrong: skips a volume of 0 | hint: The first service responded with the
replace("if answers:", "if answers and answers[0]:")
# %% 06.4 wrong: waits for the thread without a limit | hint: The function waits forever for
replace("timeout=1", "")
# %% 06.4 wrong: uses no thread | hint: The function waits forever for
replace("def ask_one(proxy, answers)", "for service in services")
replace("answers.append(proxy(length, width, height).volume)", "return rospy.ServiceProxy(service, geometry)(length, width, height).volume")
replace("pass … answers[0]", "continue")
# %% 06.4 wrong: gives up after the first failure | hint: try all services
based_on("uses no thread")
replace("for service in services:\n        try:", "try:\n        for service in services:")
replace("    except rospy.ServiceException:\n            continue\n", "except rospy.ServiceException:\n    ")
# %% 06.4 wrong: gives up after a frozen server | hint: The first service does not
replace("if answers:\n            return answers[0]", "if asker.is_alive():\n            return None\n        if answers:\n            return answers[0]")
# %% 06.4 wrong: has one time limit for all services together | hint: so calculate the time limit again for each call
replace("    for service in services:", "    end = time.monotonic() + 1\n    for service in services:")
replace("timeout=1", "timeout=max(0, end - time.monotonic())")
replace("def first_answer", "import time\n\n\ndef first_answer")
# %% 06.4 wrong: returns the last response | hint: The function returned the volume
replace("    for service in services:", "    found = None\n    for service in services:")
replace("return answers[0]\n    return None", "found = answers[0]\n    return found")
# %% 06.4 wrong: calls all services | hint: The first service responded, but the
replace("    for service in services:", "    found = []\n    for service in services:")
replace("return answers[0]\n    return None", "found.append(answers[0])\n    return found[0] if found else None")
# %% 06.4 wrong: catches no exception | hint: A failed call ended the
replace("def ask_one … return None", """for service in services:
        return rospy.ServiceProxy(service, geometry)(length, width, height).volume""")
# %% 06.4 wrong: returns the whole response | hint: Return only the field `volume`
replace("height).volume", "height)")
# %% 06.4 wrong: returns the area | hint: Return the volume from the response of
replace(".volume", ".area")
# %% 06.4 wrong: raises an error if no service responds | hint: and an exception ended the function
replace("    return None", '    raise rospy.ServiceException("no service responded")')
# %% 06.4 wrong: returns 0 if no service responds | hint: No service responded, but the function
replace("    return None", "    return 0.0")
# %% 06.4 wrong: forgets to return | hint: without a return statement
replace("return answers[0]", "print(answers[0])")

# %% 06.4 wrong: uses one list for the responses of all calls | hint: The late response of the
replace("\n        answers = []", "")
replace("    for service in services:", "    answers = []\n    for service in services:")
# %% 06.4 right: uses the function of the notebook in a generator
def ask_quietly(*arguments):
    try:
        ask(*arguments)
    except rospy.ServiceException:
        pass


def answers_of(services, sides):
    for service in services:
        found = []
        proxy = rospy.ServiceProxy(service, geometry)
        asker = threading.Thread(target=ask_quietly, args=(proxy, sides, found), daemon=True)
        asker.start()
        asker.join(timeout=1)
        yield from found[:1]


def first_answer(services, *sides):
    return next((answer.volume for answer in answers_of(services, sides)), None)

# %% 06.4 right: always waits one second for each service
replace("asker.join(timeout=1)", "rospy.sleep(1)")
# %% 06.4 wrong: waits 1.5 s for a missing service | hint: The function waits too long for a missing
def first_answer(services, length, width, height):
    def ask_one(proxy, answers):
        try:
            answers.append(proxy(length, width, height).volume)
        except rospy.ServiceException:
            pass

    for service in services:
        try:
            rospy.wait_for_service(service, timeout=1.5)
        except rospy.ROSException:
            continue
        answers = []
        asker = threading.Thread(target=ask_one, args=[rospy.ServiceProxy(service, geometry), answers], daemon=True)
        asker.start()
        asker.join(timeout=1)
        if answers:
            return answers[0]
    return None

# %% 06.4 right: waits at most 1 s for a missing service
based_on("waits 1.5 s for a missing service")
replace("timeout=1.5", "timeout=1")
# %% 06.4 wrong: uses a late response if no other service responds | hint: the function returned this late response
based_on("waits 1.5 s for a missing service")
replace("timeout=1.5", "timeout=1")
replace("    for service in services", "    calls = []\n    for service in services")
replace("answers = []\n        asker", "answers = []\n        calls.append(answers)\n        asker")
replace("    return None", "    return next((answers[0] for answers in calls if answers), None)")
# %% 06.4 wrong: sends other sides | hint: The request was repeated or
replace("proxy(length, width, height)", "proxy(0, 0, 0)")
# %% 06.4 wrong: calls only the first two services | hint: The last service can respond
replace("in services:", "in services[:2]:")

# %% 06.5 right: uses myargv and float
def read_sides(argv):
    try:
        sides = [float(text) for text in rospy.myargv(argv)[1:]]
    except ValueError:
        return None
    return sides if len(sides) == 3 else None

# %% 06.5 right: unpacks the arguments
replace("sides = [float(text) for text in rospy.myargv(argv)[1:]]", """_, length, width, height = rospy.myargv(argv=argv)
        return [float(length), float(width), float(height)]""")
replace("\n    return sides if len(sides) == 3 else None", "")
# %% 06.5 wrong: reads only the first eight lists | hint: The result has to depend on the arguments
replace("argv):", "argv, calls=[]):\n    calls.append(argv)\n    if len(calls) > 8:\n        return None")
# %% 06.5 wrong: keeps the arguments of ROS | hint: ROS uses the arguments that contain :=. Use
replace("rospy.myargv(argv)", "argv")
# %% 06.5 wrong: removes only three arguments of ROS | hint: ROS uses the arguments that contain :=. Use
replace("rospy.myargv(argv)", '[text for text in argv if text.split(":=")[0] not in ("__name", "__log", "getGeometry")]')
# %% 06.5 wrong: reads the program's name as an argument | hint: The function returned None, although `argv`
replace("(argv)[1:]", "(argv)")
# %% 06.5 wrong: returns the program's name and two sides | hint: The first item of the
replace("try: … 3 else None", "own = rospy.myargv(argv)\n    return [float(text) for text in own[:3]] if len(own) == 4 else None")
# %% 06.5 wrong: returns the numbers of an example | hint: The function returned numbers that are not in
replace("float(text)", "9.5")
# %% 06.5 wrong: returns strings | hint: The function returned strings. Convert
replace("try: … return None", "sides = rospy.myargv(argv)[1:]")
# %% 06.5 wrong: ignores a fourth argument | hint: Four numbers are too many. Return
replace("argv)[1:]", "argv)[1:4]")
# %% 06.5 wrong: does not catch ValueError | hint: float('wide') raises
replace("try: … return None", "sides = [float(text) for text in rospy.myargv(argv)[1:]]")
# %% 06.5 wrong: accepts only digits and a point | hint: -1.5 is a number
based_on("does not catch ValueError")
replace("[1:]", '[1:] if text.replace(".", "", 1).isdigit()')
# %% 06.5 wrong: accepts only digits | hint: 1.5 is a number, too
based_on("does not catch ValueError")
replace("[1:]", "[1:] if text.isdigit()")
# %% 06.5 wrong: accepts only numbers with a point | hint: 25e-2 are numbers, too
import re


def read_sides(argv):
    texts = rospy.myargv(argv)[1:]
    if len(texts) != 3 or not all(re.fullmatch(r"-?\d+\.\d+", text) for text in texts):
        return None
    return [float(text) for text in texts]

# %% 06.5 wrong: evaluates the arguments as Python literals | hint: Python evaluated an argument such as 5m
import ast


def read_sides(argv):
    try:
        sides = [float(ast.literal_eval(text)) for text in rospy.myargv(argv)[1:]]
    except ValueError:
        return None
    return sides if len(sides) == 3 else None

# %% 06.5 wrong: accepts True as a number | hint: The argument True is a word
based_on("evaluates the arguments as Python literals")
replace("except ValueError", "except (ValueError, SyntaxError)")
# %% 06.5 wrong: ignores the sign | hint: -1.5 is a number, too, so
replace("float(text)", "abs(float(text))")
# %% 06.5 wrong: skips an argument that is not a number | hint: One argument is a word. Return
replace("try:\n        sides = [float(text) for text in rospy.myargv(argv)[1:]]\n    except ValueError:\n        return None", """sides = []
    for text in rospy.myargv(argv)[1:]:
        try:
            sides.append(float(text))
        except ValueError:
            continue""")

# %% 06.5 wrong: exits the program | hint: The function ends the program. Return
import sys
def read_sides(argv):
    own = rospy.myargv(argv)[1:]
    if len(own) != 3:
        sys.exit("usage: client length width height")
    return [float(text) for text in own]

# %% 06.5 wrong: reads the arguments of the current process | hint: Read only `argv`, and
replace("(argv)[1:]", "()[1:]")
# %% 06.5 wrong: converts the numbers to int | hint: A side can be a
replace("float(text)", "int(float(text))")
# %% 06.5 wrong: accepts two numbers | hint: Two numbers are not enough
replace("len(sides) == 3", "len(sides) <= 3")
# %% 06.5 wrong: unpacks the arguments outside of try | hint: The function raised an exception
based_on("unpacks the arguments")
replace("try:\n        _, length, width, height = rospy.myargv(argv=argv)", "_, length, width, height = rospy.myargv(argv=argv)\n    try:")

# %% 06.5 wrong: returns a tuple | hint: Return a list, not a tuple
replace("return sides if", "return tuple(sides) if")

# %% 06.6 right: uses functions
solution()

# %% 06.6 right: writes all code in one block
"""%%writefile fits.py
#!/usr/bin/env python3
import sys
import rospy
from course_pkg.srv import geometry, geometryRequest

if __name__ == "__main__":
    rospy.init_node("fits")
    try:
        length, width, height, limit = map(float, rospy.myargv()[1:])
    except ValueError:
        print("usage: fits.py LENGTH WIDTH HEIGHT LIMIT", file=sys.stderr)
        sys.exit(2)
    try:
        rospy.wait_for_service("getGeometry", 2.0)
        response = rospy.ServiceProxy("getGeometry", geometry)(geometryRequest(length, width, height))
    except Exception as error:
        rospy.logerr("no answer: %s", error)
        sys.exit(3)
    if response.volume > limit:
        print("too large")
        sys.exit(1)
    print("fits")
"""

# %% 06.6 wrong: omits the shebang | hint: The shebang is missing: the first
replace("#!/usr/bin/env python3\n", "")
# %% 06.6 wrong: waits 6 s for the service | hint: The program waits too long for a missing service
replace("timeout=2", "timeout=6")
# %% 06.6 wrong: sends sides of 0 | hint: Send LENGTH, WIDTH and HEIGHT as
replace("geometry)(*sides)", "geometry)(0, 0, 0)")
# %% 06.6 wrong: omits the main guard | hint: Python cannot import the file
replace('if __name__ == "__main__":\n    sys.exit(main())', "sys.exit(main())")
# %% 06.6 wrong: omits init_node | hint: The program ignored the remapping
replace('    rospy.init_node("fits", anonymous=True)\n', "")
# %% 06.6 wrong: uses an absolute service name | hint: Remove the slash from the
replace('"getGeometry"', '"/getGeometry"', times=2)
# %% 06.6 wrong: does not remove ROS's arguments from sys.argv | hint: ROS uses the arguments that contain :=. Remove
replace("rospy.myargv(argv)", "argv")
# %% 06.6 wrong: calls the service twice | hint: The program called the service more
replace("    print(\"fits\"", "    rospy.ServiceProxy(\"getGeometry\", geometry)(*sides)\n    print(\"fits\"")
# %% 06.6 wrong: misspells a function of rospy | hint: The program ended before the
replace("rospy.wait_for_service", "rospy.wait_for_servise")
# %% 06.6 wrong: compares with < instead of <= | hint: The volume is equal to LIMIT,
replace("volume <= limit", "volume < limit", times=2)
# %% 06.6 wrong: rounds the volume before it compares | hint: do not round the volume before the comparison
replace("volume <= limit", "round(volume, 2) <= limit", times=2)
# %% 06.6 wrong: always exits with status 0 | hint: The volume in the response is larger
replace("return 0 if volume <= limit else 1", "return 0")
# %% 06.6 wrong: ignores a fifth argument | hint: The program ignored the fifth argument
based_on("writes all code in one block")
replace("rospy.myargv()[1:]", "rospy.myargv()[1:5]")
# %% 06.6 wrong: removes the digits after the point of the volume | hint: The volume in the response is larger
based_on("writes all code in one block")
replace("response.volume > limit", "int(response.volume) > limit")
# %% 06.6 wrong: returns True instead of 1 | hint: The volume in the response is at
replace("return 0 if volume <= limit else 1", "return volume <= limit")
# %% 06.6 wrong: does not catch ROSException | hint: rospy.ROSException after 2 s
replace("(rospy.ROSException, rospy.ServiceException)", "rospy.ServiceException")
# %% 06.6 wrong: does not catch ServiceException | hint: Print the message of the
replace("(rospy.ROSException, rospy.ServiceException)", "rospy.ROSException")
# %% 06.6 wrong: waits without a limit | hint: Call wait_for_service with a timeout of 2 s
replace(", timeout=2", "")
# %% 06.6 wrong: does not catch the ValueError of float() | hint: float() raises ValueError for a word
replace("    except ValueError:\n        return None\n    return numbers", "    finally:\n        pass\n    return numbers")
# %% 06.6 wrong: prints the usage with exit status 0 | hint: The arguments are not four numbers
replace("return 2", "return 0")
# %% 06.6 wrong: checks the number of arguments after the call | hint: The arguments were wrong, but the
replace("if len(numbers) == 4 else None", "if len(numbers) >= 3 else None")
replace("*sides, limit = numbers", "sides, limit = numbers[:3], numbers[3:]")
replace("    print(\"fits\" if volume <= limit", """    if len(limit) != 1:
        print("usage: fits.py LENGTH WIDTH HEIGHT LIMIT")
        return 2
    print("fits" if volume <= limit[0]""")
replace("return 0 if volume <= limit else", "return 0 if volume <= limit[0] else")
# %% 06.6 wrong: converts LIMIT after the call | hint: The arguments were wrong, but the
replace("[float(text) for text in rospy.myargv(argv)[1:]]", "rospy.myargv(argv)[1:]\n        numbers[:3] = [float(text) for text in numbers[:3]]")
replace("geometry)(*sides).volume", "geometry)(*sides).volume\n        limit = float(limit)")
replace("        return 3\n", "        return 3\n    except ValueError:\n        print(\"usage: fits.py LENGTH WIDTH HEIGHT LIMIT\")\n        return 2\n")
# %% 06.6 wrong: does not print the error message | hint: The exit status is right, but
replace("        print(error)\n", "")
# %% 06.6 wrong: calls without waiting | hint: The service started while the program
replace('        rospy.wait_for_service("getGeometry", timeout=2)\n', "")
# %% 06.6 wrong: prints other texts | hint: The exit status is right, but
replace('print("fits"', 'print("it fits"')
# %% 06.6 wrong: prints the usage with a capital letter | hint: The exit status is right, but
replace("usage:", "Usage:")
# %% 06.6 wrong: returns the error message as the exit status | hint: The exit status is 1, because
replace("        print(error)\n        return 3", "        return str(error)")
# %% 06.6 wrong: calculates the volume without the response | hint: The volume in the response is
replace("print(\"fits\" if volume", "volume = sides[0] * sides[1] * sides[2] * 1e-6\n    print(\"fits\" if volume")
# %% 06.6 wrong: prints all possible outputs | hint: The exit status is right, but
replace('if __name__ == "__main__":\n', 'if __name__ == "__main__":\n    print("usage: x\\nfits\\ntoo large")\n')
