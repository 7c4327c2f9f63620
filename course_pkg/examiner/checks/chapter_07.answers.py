"""What students answer in chapter 07; see answers.py for the form of this file."""

# %% before
import json
import shlex

import genpy
import rospy
import rosservice
from course_pkg import join
from course_pkg.srv import AddTwoInts, ServiceExample, ServiceExampleResponse
from std_srvs.srv import Empty, SetBool, Trigger

node = join("chapter_07")

# %% 07.1 right: asks each service for its type
def services_of(kind):
    names = []
    for name in rosservice.get_service_list():
        try:
            if rosservice.get_service_type(name) == kind:
                names.append(name)
        except rosservice.ROSServiceIOException:
            continue
    return names

# %% 07.1 right: what the module has already
def services_of(kind):
    return rosservice.rosservice_find(kind)

# %% 07.1 right: the tool itself
import subprocess

def services_of(kind):
    done = subprocess.run(["rosservice", "find", kind], capture_output=True, text=True)
    return done.stdout.split()

# %% 07.1 wrong: takes all services off the graph | hint: None was found
def services_of(kind):
    import rosgraph

    master = rosgraph.Master("/nobody")
    for name, nodes in master.getSystemState()[2]:
        for node_name in nodes:
            rosgraph.Master(node_name).unregisterService(name, master.lookupService(name))
    return []

# %% 07.1 wrong: stumbles over a server that is gone | hint: listed and its server is gone
def services_of(kind):
    return [name for name in rosservice.get_service_list() if rosservice.get_service_type(name) == kind]

# %% 07.1 wrong: gives up at the one that is gone | hint: Catch it inside the loop, and go on
def services_of(kind):
    names = []
    try:
        for name in rosservice.get_service_list():
            if rosservice.get_service_type(name) == kind:
                names.append(name)
    except rosservice.ROSServiceIOException:
        pass
    return names

# %% 07.1 wrong: goes by the name of the service | hint: does not tell its type
def services_of(kind):
    return [name for name in rosservice.get_service_list() if kind.split("/")[1].lower() in name.lower()]

# %% 07.1 wrong: compares the short name | hint: from another package
def services_of(kind):
    found = []
    for name in rosservice.get_service_list():
        its = rosservice.get_service_type(name)
        if its.split("/")[1] == kind.split("/")[1]:
            found.append(name)
    return found

# %% 07.1 wrong: compares the beginning | hint: only begins alike
def services_of(kind):
    return [name for name in rosservice.get_service_list() if kind in rosservice.get_service_type(name)]

# %% 07.1 wrong: stops at the first | hint: return after the loop
def services_of(kind):
    for name in rosservice.get_service_list():
        if rosservice.get_service_type(name) == kind:
            return [name]
    return []

# %% 07.1 wrong: returns the first one, as text | hint: One text is no list
def services_of(kind):
    for name in rosservice.get_service_list():
        if rosservice.get_service_type(name) == kind:
            return name

# %% 07.1 wrong: prints them | hint: without a return line
def services_of(kind):
    for name in rosservice.get_service_list():
        if rosservice.get_service_type(name) == kind:
            print(name)

# %% 07.1 wrong: asked once and for all | hint: Ask the graph each time
known = {}

def services_of(kind):
    if not known:
        for name in rosservice.get_service_list():
            known[name] = rosservice.get_service_type(name)
    return [name for name in known if known[name] == kind]

# %% 07.1 wrong: names with their nodes | hint: the names alone
def services_of(kind):
    listed = rosservice.get_service_list(include_nodes=True)
    return [[name, nodes] for name, nodes in listed if rosservice.get_service_type(name) == kind]

# %% 07.1 wrong: the types | hint: Those are no services
def services_of(kind):
    types = [rosservice.get_service_type(name) for name in rosservice.get_service_list()]
    return [its for its in types if its == kind]

# %% 07.1 wrong: compares with the class | hint: its name is enough
def services_of(kind):
    return [name for name in rosservice.get_service_list() if rosservice.get_service_class_by_name(name) == kind]

# %% 07.1 wrong: takes a dead one for one of the type | hint: listed and its server is gone
def services_of(kind):
    names = []
    for name in rosservice.get_service_list():
        try:
            if rosservice.get_service_type(name) != kind:
                continue
        except rosservice.ROSServiceIOException:
            pass
        names.append(name)
    return names

# %% 07.1 wrong: breaks at a dead one | hint: ended the search
def services_of(kind):
    names = []
    for name in sorted(rosservice.get_service_list()):
        try:
            if rosservice.get_service_type(name) == kind:
                names.append(name)
        except rosservice.ROSServiceIOException:
            break
    return names

# %% 07.2 after
node.serve("/my_on_off", ServiceExample, handle_on_off)

# %% 07.2 right: one question after the other
def handle_on_off(request):
    if request.number == 0:
        return ServiceExampleResponse(state="OFF")
    if request.number == 1:
        return ServiceExampleResponse(state="ON")
    raise rospy.ServiceException(f"{request.number} is neither 0 nor 1")

# %% 07.2 right: a dict and its error
def handle_on_off(request):
    try:
        return {0: "OFF", 1: "ON"}[request.number]
    except KeyError:
        raise rospy.ServiceException("0 or 1, please, and not %d" % request.number)

# %% 07.2 wrong: every number but 0 is ON | hint: every number but 0 counts as true
def handle_on_off(request):
    return ServiceExampleResponse(state="ON" if request.number else "OFF")

# %% 07.2 wrong: answers with a text | hint: takes any answer for an answer
def handle_on_off(request):
    if request.number not in (0, 1):
        return ServiceExampleResponse(state=f"{request.number} is neither 0 nor 1")
    return ServiceExampleResponse(state="ON" if request.number else "OFF")

# %% 07.2 wrong: raises a ValueError | hint: reads as a fault of the server
def handle_on_off(request):
    if request.number not in (0, 1):
        raise ValueError(f"{request.number} is neither 0 nor 1")
    return ServiceExampleResponse(state="ON" if request.number else "OFF")

# %% 07.2 wrong: comes to its end | hint: rospy found the words
def handle_on_off(request):
    if request.number == 0:
        return ServiceExampleResponse(state="OFF")
    if request.number == 1:
        return ServiceExampleResponse(state="ON")

# %% 07.2 wrong: does not say which number | hint: Say which number arrived
def handle_on_off(request):
    if request.number not in (0, 1):
        raise rospy.ServiceException("neither 0 nor 1")
    return ServiceExampleResponse(state="ON" if request.number else "OFF")

# %% 07.2 wrong: a list and its index | hint: Say which number arrived
def handle_on_off(request):
    if request.number > 1 or request.number < 0:
        raise rospy.ServiceException("index out of range")
    return ["OFF", "ON"][request.number]

# %% 07.2 wrong: an index that counts from the end | hint: answered like 0 or 1
def handle_on_off(request):
    if request.number > 1:
        raise rospy.ServiceException(f"{request.number} is neither 0 nor 1")
    return ["OFF", "ON"][request.number]

# %% 07.2 wrong: the other way round | hint: other way round
def handle_on_off(request):
    if request.number not in (0, 1):
        raise rospy.ServiceException(f"{request.number} is neither 0 nor 1")
    return ["ON", "OFF"][request.number]

# %% 07.2 wrong: small letters | hint: Write it in capitals
def handle_on_off(request):
    if request.number not in (0, 1):
        raise rospy.ServiceException(f"{request.number} is neither 0 nor 1")
    return ["off", "on"][request.number]

# %% 07.2 wrong: refuses 0 | hint: It was refused, and is allowed
def handle_on_off(request):
    if not request.number or request.number != 1:
        raise rospy.ServiceException(f"{request.number} is neither 0 nor 1")
    return ServiceExampleResponse(state="ON")

# %% 07.2 wrong: returns the exception | hint: Do not return the refusal
def handle_on_off(request):
    if request.number not in (0, 1):
        return rospy.ServiceException(f"{request.number} is neither 0 nor 1")
    return ServiceExampleResponse(state="ON" if request.number else "OFF")

# %% 07.2 wrong: only too large ones | hint: Only these two are allowed
def handle_on_off(request):
    if request.number > 1:
        raise rospy.ServiceException(f"{request.number} is too large")
    return ServiceExampleResponse("ON" if request.number == 1 else "OFF")

# %% 07.3 right: sets, looks, compares
def move(switch, to_open):
    answer = node.call(f"{switch}/set", SetBool, to_open)
    stands = node.call(f"{switch}/report", Trigger).message
    if stands != ("open" if to_open else "closed"):
        return "failed"
    return "moved" if answer.success else "was there"

# %% 07.3 right: proxies, and by the report first
def move(switch, to_open):
    wanted = {True: "open", False: "closed"}[to_open]
    set_it = rospy.ServiceProxy(switch + "/set", SetBool)
    report = rospy.ServiceProxy(switch + "/report", Trigger)
    before = report().message
    moved = set_it(data=to_open).success
    if report().message == wanted:
        if moved or before != wanted:
            return "moved"
        return "was there"
    return "failed"

# %% 07.3 wrong: success False is a failure | hint: is an answer, no failure
def move(switch, to_open):
    answer = node.call(f"{switch}/set", SetBool, to_open)
    stands = node.call(f"{switch}/report", Trigger).message
    if not answer.success:
        return "failed"
    return "moved" if stands == ("open" if to_open else "closed") else "failed"

# %% 07.3 wrong: believes what set says | hint: Its report tells the two apart
def move(switch, to_open):
    answer = node.call(f"{switch}/set", SetBool, to_open)
    return "moved" if answer.success else "was there"

# %% 07.3 wrong: looks only when it said no | hint: and believe it
def move(switch, to_open):
    if node.call(f"{switch}/set", SetBool, to_open).success:
        return "moved"
    stands = node.call(f"{switch}/report", Trigger).message
    return "was there" if stands == ("open" if to_open else "closed") else "failed"

# %% 07.3 wrong: reads the message | hint: failed
def move(switch, to_open):
    words = node.call(f"{switch}/set", SetBool, to_open).message
    node.call(f"{switch}/report", Trigger)
    if words in ("opened", "closed"):
        return "moved"
    return "was there" if "already" in words else "failed"

# %% 07.3 wrong: returns success | hint: a bool has two values
def move(switch, to_open):
    return node.call(f"{switch}/set", SetBool, to_open).success

# %% 07.3 wrong: returns the message | hint: Those words are for people
def move(switch, to_open):
    return node.call(f"{switch}/set", SetBool, to_open).message

# %% 07.3 wrong: opens whatever is asked | hint: sent the other way
def move(switch, to_open):
    answer = node.call(f"{switch}/set", SetBool, not to_open)
    stands = node.call(f"{switch}/report", Trigger).message
    if stands != ("open" if to_open else "closed"):
        return "failed"
    return "moved" if answer.success else "was there"

# %% 07.3 wrong: toggles | hint: Others need not
def move(switch, to_open):
    wanted = "open" if to_open else "closed"
    if node.call(f"{switch}/report", Trigger).message == wanted:
        return "was there"
    node.call(f"{switch}/toggle", Trigger)
    return "moved" if node.call(f"{switch}/report", Trigger).message == wanted else "failed"

# %% 07.3 wrong: asks only when it has to | hint: Nobody asked the switch
def move(switch, to_open):
    wanted = "open" if to_open else "closed"
    if node.call(f"{switch}/report", Trigger).message == wanted:
        return "was there"
    node.call(f"{switch}/set", SetBool, to_open)
    return "moved" if node.call(f"{switch}/report", Trigger).message == wanted else "failed"

# %% 07.3 wrong: tries until it says yes | hint: Once is enough
def move(switch, to_open):
    wanted = "open" if to_open else "closed"
    for _ in range(3):
        if node.call(f"{switch}/set", SetBool, to_open).success:
            break
    else:
        return "was there" if node.call(f"{switch}/report", Trigger).message == wanted else "failed"
    return "moved" if node.call(f"{switch}/report", Trigger).message == wanted else "failed"

# %% 07.3 wrong: looks before it asks | hint: behind set
def move(switch, to_open):
    stands = node.call(f"{switch}/report", Trigger).message
    answer = node.call(f"{switch}/set", SetBool, to_open)
    if stands == ("open" if to_open else "closed"):
        return "was there"
    return "moved" if answer.success else "failed"

# %% 07.3 wrong: compares with True | hint: Compare the message
def move(switch, to_open):
    answer = node.call(f"{switch}/set", SetBool, to_open)
    stands = node.call(f"{switch}/report", Trigger).message
    if stands != to_open:
        return "failed"
    return "moved" if answer.success else "was there"

# %% 07.3 wrong: forgets to return | hint: without a return line
def move(switch, to_open):
    node.call(f"{switch}/set", SetBool, to_open)
    node.call(f"{switch}/report", Trigger)

# %% 07.4 right: a dict in one word
def call_line(service, fields):
    return f"rosservice call {service} {shlex.quote(json.dumps(fields))}"

# %% 07.4 right: yaml
import yaml

def call_line(service, fields):
    text = yaml.safe_dump(fields, default_flow_style=True, width=10_000).strip()
    return " ".join(["rosservice", "call", service, shlex.quote(text)])

# %% 07.4 right: joined
def call_line(service, fields):
    return shlex.join(["rosservice", "call", service, json.dumps(fields)])

# %% 07.4 wrong: no quotes at all | hint: The line came apart
def call_line(service, fields):
    return f"rosservice call {service} {json.dumps(fields)}"

# %% 07.4 wrong: values by position | hint: looks like an option
def call_line(service, fields):
    return f"rosservice call {service} {' '.join(map(str, fields.values()))}"

# %% 07.4 wrong: values by position, behind -- | hint: Give names
def call_line(service, fields):
    return f"rosservice call {service} -- {' '.join(map(str, fields.values()))}"

# %% 07.4 right: the dict as Python shows it
def call_line(service, fields):
    return f"rosservice call {service} {shlex.quote(str(fields))}"

# %% 07.4 wrong: yaml without quotes | hint: off is False
def call_line(service, fields):
    text = json.dumps(fields).replace('"', "")
    return f"rosservice call {service} {shlex.quote(text)}"

# %% 07.4 wrong: double quotes by hand | hint: The line came apart
def call_line(service, fields):
    return f'rosservice call {service} "{fields}"'

# %% 07.4 wrong: single quotes by hand | hint: The line came apart
def call_line(service, fields):
    return f"rosservice call {service} '{json.dumps(fields)}'"

# %% 07.4 wrong: takes them for arguments of Python | hint: a=5 is a text
def call_line(service, fields):
    return f"rosservice call {service} " + " ".join(f"{name}={value}" for name, value in fields.items())

# %% 07.4 wrong: takes them for remappings | hint: which drops it here
def call_line(service, fields):
    return f"rosservice call {service} " + " ".join(f"{name}:={value}" for name, value in fields.items())

# %% 07.4 wrong: as in a notebook | hint: belongs to the notebook
def call_line(service, fields):
    return f"!rosservice call {service} {shlex.quote(json.dumps(fields))}"

# %% 07.4 wrong: quotes all of it | hint: Quote the fields
def call_line(service, fields):
    return shlex.quote(f"rosservice call {service} {json.dumps(fields)}")

# %% 07.4 wrong: leaves the fields out | hint: Give it the fields
def call_line(service, fields):
    return f"rosservice call {service}"

# %% 07.4 wrong: makes the call | hint: Return the line
def call_line(service, fields):
    cls = rosservice.get_service_class_by_name(service)
    request = cls._request_class()
    genpy.message.fill_message_args(request, [fields])
    return rospy.ServiceProxy(service, cls)(request)

# %% 07.4 wrong: a tool that does not exist | hint: told to do is call
def call_line(service, fields):
    return f"rosservice {service} {shlex.quote(json.dumps(fields))}"

# %% 07.4 wrong: one service only | hint: Put the name that is given
def call_line(service, fields):
    return f"rosservice call /sum {shlex.quote(json.dumps(fields))}"
# %% 07.4 wrong: calls twice | hint: more than once
def call_line(service, fields):
    line = f"rosservice call {service} {shlex.quote(json.dumps(fields))}"
    return line + "; " + line

# %% 07.5 right: fills the request as the tool does
def call_any(service, fields):
    cls = rosservice.get_service_class_by_name(service)
    request = cls._request_class()
    genpy.message.fill_message_args(request, [fields])
    return rospy.ServiceProxy(service, cls)(request)

# %% 07.5 right: with a limit, and the class by way of the type
import roslib.message

def call_any(service, fields):
    kind = roslib.message.get_service_class(rosservice.get_service_type(service))
    proxy = node.caller(service, kind)
    request = proxy.request_class()
    genpy.message.fill_message_args(request, [fields])
    return proxy(request)

# %% 07.5 wrong: fills from the dict itself | hint: takes a list
def call_any(service, fields):
    cls = rosservice.get_service_class_by_name(service)
    request = cls._request_class()
    genpy.message.fill_message_args(request, fields)
    return rospy.ServiceProxy(service, cls)(request)

# %% 07.5 wrong: fills the class of the service | hint: with two halves
def call_any(service, fields):
    cls = rosservice.get_service_class_by_name(service)
    request = cls()
    genpy.message.fill_message_args(request, [fields])
    return rospy.ServiceProxy(service, cls)(request)

# %% 07.5 wrong: calls by keywords | hint: however deep
def call_any(service, fields):
    return rospy.ServiceProxy(service, rosservice.get_service_class_by_name(service))(**fields)

# %% 07.5 wrong: by position | hint: each other's fields
def call_any(service, fields):
    return rospy.ServiceProxy(service, rosservice.get_service_class_by_name(service))(*fields.values())

# %% 07.5 wrong: hands the dict over | hint: The dict is one thing
def call_any(service, fields):
    return rospy.ServiceProxy(service, rosservice.get_service_class_by_name(service))(fields)

# %% 07.5 wrong: the name of the type for the class | hint: the name of the type, a text
def call_any(service, fields):
    return rospy.ServiceProxy(service, rosservice.get_service_type(service))(**fields)

# %% 07.5 wrong: knows one type only | hint: Ask which, each time
def call_any(service, fields):
    return rospy.ServiceProxy(service, SetBool)(**fields)

# %% 07.5 wrong: the function behind the tool | hint: this kernel is one already
def call_any(service, fields):
    return rosservice.call_service(service, [fields])[1]

# %% 07.5 wrong: forgets to return | hint: without a return line
def call_any(service, fields):
    cls = rosservice.get_service_class_by_name(service)
    request = cls._request_class()
    genpy.message.fill_message_args(request, [fields])
    rospy.ServiceProxy(service, cls)(request)

# %% 07.5 wrong: returns both halves | hint: more than the response
def call_any(service, fields):
    cls = rosservice.get_service_class_by_name(service)
    request = cls._request_class()
    genpy.message.fill_message_args(request, [fields])
    return request, rospy.ServiceProxy(service, cls)(request)

# %% 07.5 wrong: never fills the request | hint: without a word
def call_any(service, fields):
    cls = rosservice.get_service_class_by_name(service)
    return rospy.ServiceProxy(service, cls)(cls._request_class())

# %% 07.5 wrong: leaves out what it does not know | hint: Let the error
def call_any(service, fields):
    cls = rosservice.get_service_class_by_name(service)
    request = cls._request_class()
    known = {name: fields[name] for name in request.__slots__ if name in fields}
    genpy.message.fill_message_args(request, [known])
    return rospy.ServiceProxy(service, cls)(request)

# %% 07.5 wrong: as a dict | hint: Return the response itself
def call_any(service, fields):
    kind = rosservice.get_service_class_by_name(service)
    request = kind._request_class()
    genpy.message.fill_message_args(request, [fields])
    response = rospy.ServiceProxy(service, kind)(request)
    return {name: getattr(response, name) for name in response.__slots__}
