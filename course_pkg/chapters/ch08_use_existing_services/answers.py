"""Example answers of chapter 08; tests/checking/answers/example_answers.py explains the format."""

# %% 08.1 right: gets the type of each service
def services_of(kind):
    names = []
    for name in rosservice.get_service_list():
        try:
            if rosservice.get_service_type(name) == kind:
                names.append(name)
        except rosservice.ROSServiceIOException:
            continue
    return names

# %% 08.1 right: uses the function rosservice_find
replace("names = [] … return names", "return rosservice.rosservice_find(kind)")

# %% 08.1 right: uses the command rosservice find
import subprocess

def services_of(kind):
    done = subprocess.run(["rosservice", "find", kind], capture_output=True, text=True)
    return done.stdout.split()

# %% 08.1 wrong: unregisters all services | hint: Your function found no service.
def services_of(kind):
    import rosgraph

    master = rosgraph.Master("/nobody")
    for name, nodes in master.getSystemState()[2]:
        for node_name in nodes:
            rosgraph.Master(node_name).unregisterService(name, master.lookupService(name))
    return []

# %% 08.1 wrong: raises an error for a dead server | hint: Your list contains a service whose server
replace("names = [] … return names", "return [name for name in rosservice.get_service_list() if rosservice.get_service_type(name) == kind]")
# %% 08.1 wrong: stops at a dead server | hint: Your function stopped at a
replace("continue", "break")
# %% 08.1 wrong: leaves out services for loggers | hint: Select the services only by their type.
replace("        try:", '        if "logger" in name:\n            continue\n        try:')
# %% 08.1 wrong: finds only names with two parts | hint: Select the services only by their type.
replace("        try:", '        if name.count("/") != 2:\n            continue\n        try:')
# %% 08.1 wrong: decides by the name of the service | hint: Your list contains services of
replace("names = [] … return names", 'return [name for name in rosservice.get_service_list() if kind.split("/")[1].lower() in name.lower()]')
# %% 08.1 wrong: compares only the name of the type, without the package | hint: Your list contains a service whose type
replace(" == kind", '.split("/")[1] == kind.split("/")[1]')
# %% 08.1 wrong: accepts types that only contain the given type | hint: Your list contains a service with
replace("names = [] … return names", "return [name for name in rosservice.get_service_list() if kind in rosservice.get_service_type(name)]")
# %% 08.1 wrong: returns only the first service | hint: Your function found only some
replace("names.append(name)", "return [name]")
# %% 08.1 wrong: returns the first service as a string | hint: Your function returned one string.
replace("names.append(name)", "return name")
# %% 08.1 wrong: prints the services instead of returning them | hint: without a return statement
replace("names.append(name)", "print(name)")
replace("\n    return names", "")

# %% 08.1 wrong: stores the service list of the first call | hint: Your function did not find a new service
known = {}

def services_of(kind):
    if not known:
        for name in rosservice.get_service_list():
            known[name] = rosservice.get_service_type(name)
    return [name for name in known if known[name] == kind]

# %% 08.1 wrong: stores the types of earlier calls | hint: a service of your list has ended or has changed its type
types_of = {}

def services_of(kind):
    for name in rosservice.get_service_list():
        try:
            types_of[name] = types_of.get(name) or rosservice.get_service_type(name)
        except rosservice.ROSServiceIOException:
            continue
    return [name for name in types_of if types_of[name] == kind]

# %% 08.1 wrong: looks up the type of a name only once | hint: a service of your list has ended or has changed its type
type_by_name = {}

def services_of(kind):
    names = rosservice.get_service_list()
    for name in names:
        if name not in type_by_name:
            try:
                type_by_name[name] = rosservice.get_service_type(name)
            except rosservice.ROSServiceIOException:
                pass
    return [name for name in names if type_by_name.get(name) == kind]

# %% 08.1 wrong: returns the names with their nodes | hint: The entries of your list
replace("names = [] … return names", """listed = rosservice.get_service_list(include_nodes=True)
    return [[name, nodes] for name, nodes in listed if rosservice.get_service_type(name) == kind]""")
# %% 08.1 wrong: returns the types instead of the names | hint: Your list contains strings that
replace("names = [] … return names", """types = [rosservice.get_service_type(name) for name in rosservice.get_service_list()]
    return [its for its in types if its == kind]""")
# %% 08.1 wrong: compares the type with the class | hint: The type of a service is
based_on("raises an error for a dead server")
replace("get_service_type", "get_service_class_by_name")
# %% 08.1 wrong: also returns the service of a dead server | hint: Your list contains a service whose server
replace("== kind:\n                names.append(name)", "!= kind:\n                continue")
replace("\n            continue", "\n            pass\n        names.append(name)")
# %% 08.1 wrong: leaves the loop at a dead server | hint: Your function stopped at a
replace("rosservice.get_service_list()", "sorted(rosservice.get_service_list())")
replace("continue", "break")
# %% 08.1 wrong: returns None if there is no service | hint: Return an empty list
replace("return names", "return names or None")
# %% 08.1 wrong: returns a generator | hint: Your function did not return
replace("names = [] … return names", "return (name for name in rosservice.get_service_list() if rosservice.get_service_type(name) == kind)")

# %% 08.1 wrong: reads the service list only once | hint: Your function found no service.
replace("def services_of(kind):", "NAMES = rosservice.get_service_list()\n\n\ndef services_of(kind):")
replace("in rosservice.get_service_list():", "in NAMES:")
# %% 08.1 wrong: calls the services | hint: The function called the services to find their type
replace("            if rosservice", "            cls = rosservice.get_service_class_by_name(name)\n            rospy.ServiceProxy(name, cls)()\n            if rosservice")
replace("except rosservice.ROSServiceIOException", "except Exception")
# %% 08.1 wrong: calls the services from the second call on | hint: The function called the services to find their type
based_on("calls the services")
replace("def services_of(kind):", "def services_of(kind, runs=[]):")
replace("            rospy.ServiceProxy(name, cls)()", "            runs and rospy.ServiceProxy(name, cls)()")
replace("    return names", "    runs.append(kind)\n    return names")
# %% 08.1 wrong: returns the names of a fixed table | hint: Your list contains names of services that do not exist
def services_of(kind):
    return ["/switch/a_report", "/switch/a_toggle"]

# %% 08.1 wrong: returns a list with an empty string | hint: The list contains an empty string.
replace("    return names", '    return names or [""]')

# %% 08.2 right: uses a function as the handler
def handle_lamp(request):
    on_off = rospy.ServiceProxy("/on_off", ServiceExample)
    try:
        state = on_off(1 if request.data else 0).state
    except rospy.ServiceException as error:
        return SetBoolResponse(success=False, message=str(error))
    return SetBoolResponse(success=state == ("ON" if request.data else "OFF"), message=state)


lamp_service = rospy.Service("/lamp", SetBool, handle_lamp)

# %% 08.2 right: uses an object that creates its service
class Lamp:
    def __init__(self):
        self.on_off = rospy.ServiceProxy("/on_off", ServiceExample)
        self.service = rospy.Service("/lamp", SetBool, self.handle)

    def handle(self, request):
        try:
            answer = self.on_off(number=int(request.data))
        except rospy.ServiceException as error:
            return False, f"{error}"
        return {"success": ["OFF", "ON"].index(answer.state) == request.data, "message": answer.state}


def handle_lamp(request):
    return lamp.handle(request)


lamp = Lamp()

# %% 08.2 right: uses a partial function and a lambda function
import functools


def handle_lamp(on_off, request):
    wanted = {True: (1, "ON"), False: (0, "OFF")}[request.data]
    try:
        state = on_off(wanted[0]).state
    except Exception as error:
        return SetBoolResponse(False, str(error))
    return SetBoolResponse(state == wanted[1], state)


handler = functools.partial(handle_lamp, rospy.ServiceProxy("/on_off", ServiceExample))
lamp_service = rospy.Service("/lamp", SetBool, lambda request: handler(request))

# %% 08.2 wrong: catches no exception | hint: The call of /lamp failed, because
replace("on_off = rospy … str(error))", 'state = rospy.ServiceProxy("/on_off", ServiceExample)(int(request.data)).state')
# %% 08.2 wrong: waits, but does not catch the timeout | hint: did not catch rospy.ROSException
replace("        state =", '        rospy.wait_for_service("/on_off", timeout=1)\n        state =')
# %% 08.2 wrong: raises the refusal again | hint: The call of /lamp failed, because
replace("return SetBoolResponse(success=False, message=str(error))", "raise rospy.ServiceException(str(error))")
# %% 08.2 wrong: returns the exception as the message | hint: The field `message` has to
replace("str(error)", "error")
# %% 08.2 wrong: returns a fixed message | hint: The message does not contain
replace("str(error)", '"it does not work"')
# %% 08.2 wrong: returns success=True after a failed call | hint: The call of /on_off failed
replace("success=False", "success=True")
# %% 08.2 wrong: returns success=True if switching off fails | hint: The call of /on_off failed
replace("success=False", "success=not request.data")
# %% 08.2 wrong: returns success=True for any response | hint: The lamp responded with the wrong
replace('success=state == ("ON" if request.data else "OFF")', "success=True")
# %% 08.2 wrong: returns the wanted state as the message | hint: The message is the wanted
replace("message=state", 'message="ON" if request.data else "OFF"')
# %% 08.2 wrong: compares the state with True | hint: The lamp has the wanted state
replace('state == ("ON" if request.data else "OFF")', "state is request.data")
# %% 08.2 wrong: returns a sentence as the message | hint: The message is wrong. Return
replace("message=state", 'message=f"the lamp is {state}"')
# %% 08.2 wrong: exchanges the numbers 0 and 1 | hint: The number in the request to /on_off is
replace("1 if request.data else 0", "0 if request.data else 1")
# %% 08.2 wrong: sends other numbers than 0 and 1 | hint: The number in the request to /on_off has
replace("1 if request.data else 0", "2 if request.data else 3")
# %% 08.2 wrong: calls /on_off twice | hint: The handler called /on_off more than once
replace("state = on_off", "on_off(0)\n        state = on_off")
# %% 08.2 wrong: does not call /on_off | hint: The handler did not call /on_off
replace("on_off(1 if request.data else 0).state", '"ON" if request.data else "OFF"')
# %% 08.2 wrong: misspells a field | hint: The request has no field
replace("1 if request.data", "1 if request.date")
# %% 08.2 wrong: uses a local variable before it has a value | hint: The handler assigns a value
replace("\n    on_off = rospy … else 0).state", "\n    try:\n        on_off = on_off(1 if request.data else 0).state")
replace('state == ("ON" if request.data else "OFF"), message=', 'on_off.state == ("ON" if request.data else "OFF"), message=on_off.')
# %% 08.2 wrong: uses a name that does not exist | hint: The handler uses a name that does not exist
replace("(\"/on_off\", ServiceExample)", "(\"/on_off\", ServiceExmaple)")
# %% 08.2 wrong: passes the result of the handler instead of the handler | hint: Pass the name of the handler without
replace('SetBool, handle_lamp)', 'SetBool, handle_lamp(SetBool._request_class(data=False)))')

# %% 08.2 right: waits for the lamp for at most 1 s
replace("    try:\n", '    try:\n        rospy.wait_for_service("/on_off", timeout=1)\n')
replace("except rospy.ServiceException", "except (rospy.ServiceException, rospy.ROSException)")
# %% 08.2 right: uses an object, and no function handle_lamp
class Bridge:
    STATES = {True: (1, "ON"), False: (0, "OFF")}

    def __init__(self):
        self.on_off = rospy.ServiceProxy("/on_off", ServiceExample)

    def handle(self, request):
        number, wanted = self.STATES[request.data]
        try:
            state = self.on_off(number=number).state
        except rospy.ServiceException as error:
            return False, f"{error}"
        return state == wanted, state


lamp_service = rospy.Service("/lamp", SetBool, Bridge().handle)
# %% 08.2 wrong: calls until the state is right | hint: The handler repeated the call
replace("state = on_off(1 if request.data else 0).state", """for _ in range(3):
            state = on_off(1 if request.data else 0).state
            if state == ("ON" if request.data else "OFF"):
                break""")

# %% 08.3 right: calls set, reads the report, and compares
def move(switch, to_open):
    answer = rospy.ServiceProxy(f"{switch}/set", SetBool)(to_open)
    stands = rospy.ServiceProxy(f"{switch}/report", Trigger)().message
    if stands != ("open" if to_open else "closed"):
        return "failed"
    return "moved" if answer.success else "was there"

# %% 08.3 right: reads the report before set and after it
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

# %% 08.3 wrong: treats success=False as a failure | hint: success=False does not always mean
replace('stands != ("open" if to_open else "closed")', "not answer.success")
replace('answer.success else "was there"', 'stands == ("open" if to_open else "closed") else "failed"')
# %% 08.3 wrong: does not read the report | hint: The switch responded with success=False and is in the wrong
replace('\n    stands = rospy … return "failed"', "")
# %% 08.3 wrong: reads the report only if success is False | hint: The switch responded with success=True
replace('answer = rospy.ServiceProxy(f"{switch}/set", SetBool)(to_open)', '''if rospy.ServiceProxy(f"{switch}/set", SetBool)(to_open).success:
        return "moved"''')
replace('if stands ! … was there"', 'return "was there" if stands == ("open" if to_open else "closed") else "failed"')

# %% 08.3 wrong: trusts success=True | hint: compare the position with `to_open`, even if success
replace('if stands != ("open" if to_open else "closed"):', 'if stands != ("open" if to_open else "closed") and not answer.success:')
# %% 08.3 wrong: reads the position from the message of set | hint: The switch is in the wanted
def move(switch, to_open):
    words = rospy.ServiceProxy(f"{switch}/set", SetBool)(to_open).message
    rospy.ServiceProxy(f"{switch}/report", Trigger)()
    if words in ("opened", "closed"):
        return "moved"
    return "was there" if "already" in words else "failed"

# %% 08.3 wrong: returns the field success | hint: Your function returned a bool
replace('answer = rospy … was there"', 'return rospy.ServiceProxy(f"{switch}/set", SetBool)(to_open).success')
# %% 08.3 wrong: returns the field message | hint: Your function returned the message
based_on("returns the field success")
replace("success", "message")
# %% 08.3 wrong: moves in the opposite direction | hint: The field `data` of the
replace("SetBool)(to_open)", "SetBool)(not to_open)")

# %% 08.3 wrong: calls toggle | hint: Call only the services `set`
def move(switch, to_open):
    wanted = "open" if to_open else "closed"
    if rospy.ServiceProxy(f"{switch}/report", Trigger)().message == wanted:
        return "was there"
    rospy.ServiceProxy(f"{switch}/toggle", Trigger)()
    return "moved" if rospy.ServiceProxy(f"{switch}/report", Trigger)().message == wanted else "failed"

# %% 08.3 wrong: calls set only if the report differs | hint: The function did not call `set`.
based_on("calls toggle")
replace('"{switch}/toggle", Trigger)()', '"{switch}/set", SetBool)(to_open)')
# %% 08.3 wrong: repeats until success is True | hint: The function called `set` more than
based_on("calls toggle")
replace('if rospy.ServiceProxy(f"{switch}/report", Trigger)().message == wanted: … Trigger)()', '''for _ in range(3):
        if rospy.ServiceProxy(f"{switch}/set", SetBool)(to_open).success:
            break
    else:
        return "was there" if rospy.ServiceProxy(f"{switch}/report", Trigger)().message == wanted else "failed"''')

# %% 08.3 wrong: reads the report only before set | hint: The switch responded with success=True, but
def move(switch, to_open):
    stands = rospy.ServiceProxy(f"{switch}/report", Trigger)().message
    answer = rospy.ServiceProxy(f"{switch}/set", SetBool)(to_open)
    if stands == ("open" if to_open else "closed"):
        return "was there"
    return "moved" if answer.success else "failed"

# %% 08.3 wrong: compares the message with a bool | hint: Compare the message
replace('("open" if to_open else "closed")', "to_open")
# %% 08.3 wrong: stores the results | hint: Call `set` each time move() runs
replace("def move", "import functools\n\n\n@functools.lru_cache(maxsize=None)\ndef move")
# %% 08.3 wrong: forgets to return | hint: without a return statement
replace('answer = rospy … was there"', """rospy.ServiceProxy(f"{switch}/set", SetBool)(to_open)
    rospy.ServiceProxy(f"{switch}/report", Trigger)()""")
# %% 08.3 wrong: treats success=True as "was there" | hint: The switch responded with success=True and is in the wanted position, so
replace('"moved" if answer.success else "was there"', '"was there" if answer.success else "moved"')
# %% 08.3 wrong: ignores the field success | hint: it was in this position before
replace(' if answer.success else "was there"', "")
# %% 08.3 wrong: writes the result with a capital letter | hint: Write the string exactly as
replace('"moved"', '"Moved"')

# %% 08.3 wrong: calls set again in a thread | hint: The function called `set` more than
import threading


def move(switch, to_open):
    turn = rospy.ServiceProxy(f"{switch}/set", SetBool)
    threading.Timer(0.05, turn, [to_open]).start()
    answer, stands = turn(to_open), rospy.ServiceProxy(f"{switch}/report", Trigger)().message
    if stands != ("open" if to_open else "closed"):
        return "failed"
    return "moved" if answer.success else "was there"

# %% 08.3 wrong: compares two reports instead of reading success | hint: use the field `success`, not
def move(switch, to_open):
    report = rospy.ServiceProxy(f"{switch}/report", Trigger)
    before = report().message
    rospy.ServiceProxy(f"{switch}/set", SetBool)(to_open)
    after = report().message
    if after != ("open" if to_open else "closed"):
        return "failed"
    return "moved" if before != after else "was there"

# %% 08.4 right: passes the dict as one argument
def call_line(service, fields):
    return f"rosservice call {service} {shlex.quote(json.dumps(fields))}"

# %% 08.4 right: uses yaml
import yaml

def call_line(service, fields):
    text = yaml.safe_dump(fields, default_flow_style=True, width=10_000).strip()
    return " ".join(["rosservice", "call", service, shlex.quote(text)])

# %% 08.4 right: uses shlex.join
replace('f"rosservice call {service} {shlex.quote(json.dumps(fields))}"', 'shlex.join(["rosservice", "call", service, json.dumps(fields)])')
# %% 08.4 wrong: uses no quotes | hint: bash has split the fields
replace("shlex.quote(json.dumps(fields))", "json.dumps(fields)")
# %% 08.4 wrong: writes the values by position | hint: rosservice reads -5 as an
replace("{shlex.quote(json.dumps(fields))}", "{' '.join(map(str, fields.values()))}")
# %% 08.4 wrong: writes the values by position after -- | hint: The values are in the wrong fields, because
based_on("writes the values by position")
replace("{service} ", "{service} -- ")
# %% 08.4 wrong: writes the dict as Python shows it | hint: YAML cannot read a dict
replace("json.dumps", "str")

# %% 08.4 wrong: writes YAML without quotes | hint: YAML read a value that differs
def call_line(service, fields):
    text = json.dumps(fields).replace('"', "")
    return f"rosservice call {service} {shlex.quote(text)}"

# %% 08.4 wrong: adds double quotes without shlex | hint: YAML cannot read a dict
replace('"rosservice call {service} {shlex.quote(json.dumps(fields))}"', "'rosservice call {service} \"{fields}\"'")
# %% 08.4 wrong: adds single quotes without shlex | hint: bash has split the fields
replace("{shlex.quote(json.dumps(fields))}", "'{json.dumps(fields)}'")
# %% 08.4 wrong: writes the fields as NAME=VALUE | hint: YAML reads a=5 as a string
replace('"rosservice call {service} {shlex.quote(json.dumps(fields))}"', '"rosservice call {service} " + " ".join(f"{name}={value}" for name, value in fields.items())')
# %% 08.4 wrong: writes the fields as NAME:=VALUE | hint: ROS reads an argument with
replace('"rosservice call {service} {shlex.quote(json.dumps(fields))}"', '"rosservice call {service} " + " ".join(f"{name}:={value}" for name, value in fields.items())')
# %% 08.4 wrong: begins the line with !, as in a notebook | hint: The character ! works only in a
replace("rosservice", "!rosservice")
# %% 08.4 wrong: quotes the whole line | hint: Because of the quotes, bash
replace('f"rosservice call {service} {shlex.quote(json.dumps(fields))}"', 'shlex.quote(f"rosservice call {service} {json.dumps(fields)}")')
# %% 08.4 wrong: omits the fields | hint: rosservice received no values. Write the
replace(" {shlex.quote(json.dumps(fields))}", "")

# %% 08.4 wrong: calls the service | hint: Your function called the service. Return
def call_line(service, fields):
    cls = rosservice.get_service_class_by_name(service)
    request = cls._request_class()
    genpy.message.fill_message_args(request, [fields])
    return rospy.ServiceProxy(service, cls)(request)

# %% 08.4 wrong: makes the call, and returns a line without a call | hint: Your function called the service. Return
def call_line(service, fields):
    rosservice.call_service(service, [fields])
    return "rosservice call --help"

# %% 08.4 wrong: writes a tool that does not exist | hint: The command is missing in
replace("call {service}", "{service}")
# %% 08.4 wrong: writes a fixed service | hint: The name of the service
replace("call {service}", "call /sum")
# %% 08.4 wrong: calls the service twice | hint: The line calls the service more than once
replace('return f"rosservice call {service} {shlex.quote(json.dumps(fields))}"', """line = f"rosservice call {service} {shlex.quote(json.dumps(fields))}"
    return line + "; " + line""")
# %% 08.4 wrong: writes the call as in Python | hint: without parentheses
replace(" {service} {shlex.quote(json.dumps(fields))}", "({service}, {fields})")
# %% 08.4 wrong: returns a list of words | hint: Your function returned a list
based_on("uses shlex.join")
replace("shlex.join(", "list(")

# %% 08.4 wrong: uses quotes for Windows | hint: bash has replaced $HOME
import subprocess


def call_line(service, fields):
    return subprocess.list2cmdline(["rosservice", "call", service, json.dumps(fields)])

# %% 08.4 wrong: creates the fields with another command | hint: A different program calls the
replace("{shlex.quote(json.dumps(fields))}", '\\"$(echo {shlex.quote(json.dumps(fields))})\\"')
# %% 08.4 wrong: omits inner dicts | hint: A field in an inner
replace("json.dumps(fields)", "json.dumps({name: value for name, value in fields.items() if not isinstance(value, dict)})")
# %% 08.4 wrong: calls the service with a Python program | hint: A different program calls the
def call_line(service, fields):
    code = f"import rosservice; rosservice.call_service({service!r}, [{fields!r}])"
    return f"python3 -c {shlex.quote(code)} # rosservice call"

# %% 08.5 right: fills the request with fill_message_args
def call_any(service, fields):
    cls = rosservice.get_service_class_by_name(service)
    request = cls._request_class()
    genpy.message.fill_message_args(request, [fields])
    return rospy.ServiceProxy(service, cls)(request)

# %% 08.5 right: gets the class from the name of the type
import roslib.message

def call_any(service, fields):
    kind = roslib.message.get_service_class(rosservice.get_service_type(service))
    proxy = rospy.ServiceProxy(service, kind)
    request = proxy.request_class()
    genpy.message.fill_message_args(request, [fields])
    return proxy(request)

# %% 08.5 wrong: passes the dict without a list | hint: The second argument of fill_message_args
replace("[fields]", "fields")
# %% 08.5 wrong: fills the service class instead of a request | hint: an object of the wrong class
replace("cls._request_class()", "cls()")
# %% 08.5 wrong: passes the fields as keyword arguments | hint: The field `camera_info` needs a message,
replace("cls = rosservice … )(request)", "return rospy.ServiceProxy(service, rosservice.get_service_class_by_name(service))(**fields)")
# %% 08.5 wrong: passes the fields by position | hint: The values are in the wrong fields.
based_on("passes the fields as keyword arguments")
replace("(**fields)", "(*fields.values())")
# %% 08.5 wrong: passes the dict to the proxy | hint: The request does not contain
based_on("passes the fields as keyword arguments")
replace("(**fields)", "(fields)")
# %% 08.5 wrong: passes the name of the type instead of the class | hint: Your function used the name
based_on("passes the fields as keyword arguments")
replace("get_service_class_by_name", "get_service_type")
# %% 08.5 wrong: uses a fixed type | hint: Your function used a wrong type for this service.
replace("cls = rosservice … )(request)", "return rospy.ServiceProxy(service, SetBool)(**fields)")
# %% 08.5 wrong: uses a table of types | hint: Your function found no type
replace("rosservice.get_service_class_by_name(service)", '{"/switch/set": SetBool}[service]')
# %% 08.5 wrong: uses a table of types with a default type | hint: Your function used a wrong type for this service.
replace("rosservice.get_service_class_by_name(service)", '{"/switch/set": SetBool}.get(service, Trigger)')
replace("def call_any", "from std_srvs.srv import Trigger\n\n\ndef call_any")
# %% 08.5 wrong: stores the type of each name | hint: This service had a different
kinds = {}

def call_any(service, fields):
    if service not in kinds:
        kinds[service] = rosservice.get_service_class_by_name(service)
    request = kinds[service]._request_class()
    genpy.message.fill_message_args(request, [fields])
    return rospy.ServiceProxy(service, kinds[service])(request)

# %% 08.5 wrong: uses rosservice.call_service | hint: rosservice.call_service raises its own exception
replace("cls = rosservice … )(request)", "return rosservice.call_service(service, [fields])[1]")
# %% 08.5 wrong: forgets to return | hint: without a return statement
replace("return rospy", "rospy")
# %% 08.5 wrong: returns request and response | hint: The function returned a list
replace("rospy", "request, rospy")
# %% 08.5 wrong: never fills the request | hint: All fields of the request
replace("request = cls … )(request)", "return rospy.ServiceProxy(service, cls)(cls._request_class())")
# %% 08.5 wrong: ignores unknown fields | hint: The function ignored a field name
replace("()", "()\n    known = {name: fields[name] for name in request.__slots__ if name in fields}")
replace("[fields]", "[known]")
# %% 08.5 wrong: refuses only one unknown name | hint: The function ignored a field name
based_on("ignores unknown fields")
replace("{name: fields[name] for name in request.__slots__ if name in fields}", '{name: fields[name] for name in fields if name in request.__slots__ or name == "dat"}')
# %% 08.5 wrong: ignores unknown fields of an inner dict | hint: The function ignored a field name
def call_any(service, fields):
    def known(message, values):
        return {
            name: known(getattr(message, name), value) if isinstance(value, dict) else value
            for name, value in values.items()
            if name in message.__slots__
        }

    cls = rosservice.get_service_class_by_name(service)
    request = cls._request_class()
    inner = {
        name: known(getattr(request, name), value) if isinstance(value, dict) else value
        for name, value in fields.items()
    }
    genpy.message.fill_message_args(request, [inner])
    return rospy.ServiceProxy(service, cls)(request)

# %% 08.5 wrong: returns a dict | hint: The function returned a dict
replace("cls =", "kind =")
replace("cls._request_class", "kind._request_class")
replace("return rospy.ServiceProxy(service, cls)(request)", """response = rospy.ServiceProxy(service, kind)(request)
    return {name: getattr(response, name) for name in response.__slots__}""")
# %% 08.5 wrong: returns the proxy | hint: The function did not call the service
replace("cls)(request)", "cls)")
# %% 08.5 wrong: calls the service twice | hint: The function called the service more
replace("return rospy", "rospy.ServiceProxy(service, cls)(request)\n    return rospy")
# %% 08.5 wrong: returns one field of the response | hint: The function did not return
replace("cls)(request)", "cls)(request).message")

# %% 08.5 wrong: passes the request class to rospy.ServiceProxy | hint: Your function passed the class
replace("rospy.ServiceProxy(service, cls)", "rospy.ServiceProxy(service, cls._request_class)")
# %% 08.5 wrong: sends the return value of fill_message_args | hint: Your function sent the return
replace("    genpy", "    request = genpy")
# %% 08.5 wrong: returns lines of text | hint: The function returned lines of
replace("return rospy.ServiceProxy(service, cls)(request)", "return str(rospy.ServiceProxy(service, cls)(request)).splitlines()")

# %% 08.6 right: uses the headers of the service
def diagnose(service, kind):
    uri = rosservice.get_service_uri(service)
    if uri is None:
        return "not registered"
    try:
        headers = rosservice.get_service_headers(service, uri)
    except rosservice.ROSServiceIOException:
        return "server is gone"
    if headers["type"] != kind._type:
        return "another type"
    return "ok" if headers["md5sum"] == kind._md5sum else "another definition"

# %% 08.6 right: uses other functions of rosservice
def diagnose(service, kind):
    if service not in rosservice.get_service_list():
        return "not registered"
    try:
        its_type = rosservice.get_service_type(service)
        its_sum = rosservice.get_service_headers(service, rosservice.get_service_uri(service)).get("md5sum")
    except Exception:
        return "server is gone"
    for condition, result in ((its_type != kind._type, "another type"), (its_sum != kind._md5sum, "another definition")):
        if condition:
            return result
    return "ok"

# %% 08.6 wrong: does not check for None | hint: get_service_uri returned None, and your
replace("    if uri is None:\n        return \"not registered\"\n", "")
# %% 08.6 wrong: catches no exception | hint: Catch ROSServiceIOException.
replace("    try:\n        headers", "    if True:\n        headers")
replace("    except rosservice.ROSServiceIOException:\n        return \"server is gone\"\n", "")
# %% 08.6 wrong: compares only the types | hint: Compare the MD5 sums, too
replace('return "ok" if headers["md5sum"] == kind._md5sum else "another definition"', 'return "ok"')
# %% 08.6 wrong: compares only the MD5 sums | hint: The server and the client have types with different names
replace('if headers["type … definition"', 'if headers["md5sum"] == kind._md5sum:\n        return "ok"\n    return "another definition"')
# %% 08.6 wrong: treats every error as a missing server | hint: The master has an address for
replace('"server is gone"', '"not registered"')
# %% 08.6 wrong: treats a missing service as a dead server | hint: so get_service_uri returns None
replace('"not registered"', '"server is gone"')
# %% 08.6 wrong: compares the type with the class | hint: Compare the entry `type` of the headers
replace('headers["type"] != kind._type', 'headers["type"] != kind')
# %% 08.6 wrong: reads a header entry that does not exist | hint: Your function uses a key
replace('headers["md5sum"]', 'headers["md5"]')
# %% 08.6 wrong: uses the class on this computer | hint: The type of the server
replace("headers = rosservice.get_service_headers(service, uri)", "its = rosservice.get_service_class_by_name(service)")
replace('headers["type"]', "its._type")
replace('headers["md5sum"]', "its._md5sum")
# %% 08.6 wrong: stores the results | hint: the graph has changed, but the result is the same
replace("def diagnose", "import functools\n\n\n@functools.lru_cache(maxsize=None)\ndef diagnose")
# %% 08.6 wrong: prints the result instead of returning it | hint: without a return statement
replace('return "ok" if', 'print("ok" if')
replace('else "another definition"', 'else "another definition")')
# %% 08.6 wrong: returns a bool | hint: Return one of the five strings
replace('return "ok" if headers["md5sum"] == kind._md5sum else "another definition"', 'return headers["md5sum"] == kind._md5sum')
# %% 08.6 wrong: calls the service | hint: Use only get_service_uri and
replace('return "ok" if', "rospy.ServiceProxy(service, kind)(kind._request_class())\n    return \"ok\" if")
# %% 08.6 wrong: calls the service from the second call on | hint: Use only get_service_uri and
replace("def diagnose(service, kind):", "def diagnose(service, kind, runs=[]):")
replace('return "ok" if', """if runs and headers["md5sum"] == kind._md5sum:
        rospy.ServiceProxy(service, kind)()
    runs.append(service)
    return "ok" if""")
# %% 08.6 wrong: compares the MD5 sum of the request | hint: The MD5 sums are equal
replace("kind._md5sum", "kind._request_class._md5sum")
# %% 08.6 wrong: reverses the check for None | hint: so the client can connect
replace("uri is None", "uri is not None")
# %% 08.6 wrong: compares only the last part of the type | hint: The server and the client have types with different names
replace('headers["type"] != kind._type', 'headers["type"].split("/")[1] != kind._type.split("/")[1]')
# %% 08.6 wrong: ignores the types if the MD5 sums are equal | hint: The server and the client have types with different names
replace('headers["type"] != kind._type', 'headers["type"] != kind._type and headers["md5sum"] != kind._md5sum')
