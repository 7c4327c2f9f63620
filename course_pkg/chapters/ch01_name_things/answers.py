"""Example answers of chapter 01; tests/checking/answers/example_answers.py explains the format."""

# %% 01.1 right: uses a namespace and two new names
def measurer_command(room):
    return f"rosrun course_pkg server __ns:=/{room} __name:=measurer getGeometry:=measure"

# %% 01.1 right: writes each name with its namespace
def measurer_command(room):
    names = [f"__name:=/{room}/measurer", f"getGeometry:=/{room}/measure"]
    return " ".join(["rosrun", "course_pkg", "server", *names])

# %% 01.1 right: uses quotes, and a namespace without a slash
replace('f"rosrun course_pkg server __ns:=/{room} __name:=measurer getGeometry:=measure"', "\"rosrun course_pkg server 'getGeometry:=measure' __ns:=\" + room + \" '__name:=measurer'\"")
# %% 01.1 wrong: gives the service a global name | hint: but the name of the service is /measure
replace("getGeometry:=measure", "getGeometry:=/measure")
# %% 01.1 wrong: uses no namespace | hint: The name of the service is /measure for
replace("__ns:=/{room} ", "")
# %% 01.1 wrong: does not rename the service | hint: The service is in the namespace
replace(" getGeometry:=measure", "")
# %% 01.1 wrong: exchanges the old and the new name of the service | hint: with the old name first
replace("getGeometry:=measure", "measure:=getGeometry")
# %% 01.1 wrong: renames the type instead of the service | hint: not the name of its type
replace("getGeometry:=", "geometry:=")
# %% 01.1 wrong: writes the room twice | hint: The service's name contains the room twice
replace(":=measure\"", ":={room}/measure\"")
# %% 01.1 wrong: does not rename the node | hint: Change the name of the
replace(" __name:=measurer", "")
# %% 01.1 wrong: puts only the service into the room's namespace | hint: The node is not in the namespace of the room … The nodes of two rooms
replace("__ns:=/{room} ", "")
replace("getGeometry:=measure", "getGeometry:=/{room}/measure")
# %% 01.1 wrong: always uses the kitchen | hint: The name of the service is wrong.
replace("{room}", "kitchen")
# %% 01.1 wrong: writes = instead of := | hint: The service still has its old
replace(":=", "=", times=3)
# %% 01.1 wrong: writes spaces around := | hint: The service still has its old
replace(":=", " := ", times=3)
# %% 01.1 wrong: writes spaces around := for the service | hint: with the old name first
replace("Geometry:=m", "Geometry := m")
# %% 01.1 wrong: runs another program | hint: The command has to begin with
replace("server", "pulse")
# %% 01.1 wrong: uses roslaunch | hint: The command has to begin with
replace("rosrun", "roslaunch")
# %% 01.1 wrong: forgets to return | hint: without a return statement
replace("return ", "command = ")
# %% 01.1 wrong: gives the node another name | hint: The node has to be `measurer`
replace("__name:=measurer", "__name:=measure")
# %% 01.1 wrong: gives the service a private name | hint: A name that begins with
replace("getGeometry:=", "getGeometry:=~")
# %% 01.1 wrong: returns a list of words | hint: Return one string with spaces between
replace('getGeometry:=measure"', 'getGeometry:=measure".split()')
# %% 01.1 wrong: begins the command with %, as in a notebook | hint: works only in a notebook. Remove
replace("rosrun", "%rosrun")
# %% 01.1 wrong: starts the program instead of returning the command | hint: Your function has to return
replace("return ", "import subprocess\n    return subprocess.Popen(")
replace('getGeometry:=measure"', 'getGeometry:=measure".split())')
# %% 01.1 wrong: writes the new names in a comment of the shell | hint: The service still has its old name
def measurer_command(room):
    return f"rosrun course_pkg server # __ns:=/{room} __name:=measurer getGeometry:=measure"
# %% 01.1 wrong: adds a second command | hint: Your string contains more than one command
def measurer_command(room):
    return f"rosrun course_pkg server; rosrun course_pkg server __ns:=/{room} __name:=measurer"

# %% 01.1 wrong: starts a second node in a pipe | hint: Your string contains more than one command
def measurer_command(room):
    names = f"__ns:=/{room} __name:=measurer"
    return f"rosrun course_pkg server {names} getGeometry:=measure | rosrun course_pkg pulse {names}"
# %% 01.1 wrong: converts the name of the room to small letters | hint: In ROS, a name with a capital letter
replace("{room} __name", "{room.lower()} __name")

# %% 01.2 right: uses four remappings
def viewer_command(arm):
    return (
        f"rosrun course_pkg simulator __ns:=/screen __name:={arm}_viewer "
        f"joint_states:=/{arm}/joint_states mirrored_joints:={arm}/mirrored_joints"
    )

# %% 01.2 right: uses global names
def viewer_command(arm):
    words = ["rosrun", "course_pkg", "simulator", "__ns:=screen", "__name:=" + arm + "_viewer"]
    words += [f"joint_states:=/{arm}/joint_states", f"mirrored_joints:=/screen/{arm}/mirrored_joints"]
    return " ".join(words)

# %% 01.2 wrong: registers the names at the master without a viewer | hint: The node still has its default name. Choose
def viewer_command(arm):
    viewer = rosgraph.Master(f"/screen/{arm}_viewer")
    uri = rospy.get_node_uri()
    viewer.registerSubscriber(f"/{arm}/joint_states", "sensor_msgs/JointState", uri)
    viewer.registerPublisher(f"/screen/{arm}/mirrored_joints", "sensor_msgs/JointState", uri)
    return "rosrun course_pkg simulator --help"

# %% 01.2 wrong: registers the topics of the viewer at the master | hint: The viewer on the graph is not
import threading


def viewer_command(arm):
    name = f"/screen/{arm}_viewer"

    def register():
        viewer = rosgraph.Master(name)
        uri = ""
        while not uri:
            try:
                uri = viewer.lookupNode(name)
            except rosgraph.MasterException:
                rospy.sleep(0.02)
        viewer.registerSubscriber(f"/{arm}/joint_states", "sensor_msgs/JointState", uri)
        viewer.registerPublisher(f"/screen/{arm}/mirrored_joints", "sensor_msgs/JointState", uri)

    threading.Thread(target=register, daemon=True).start()
    return f"rosrun course_pkg simulator __ns:=/screen __name:={arm}_viewer"

# %% 01.2 wrong: does not remap joint_states | hint: The viewer subscribes to a
replace("joint_states:=/{arm}/joint_states ", "")
# %% 01.2 wrong: gives joint_states a relative name | hint: The new name of the topic is relative
replace("joint_states:=/{arm}", "joint_states:={arm}")
# %% 01.2 wrong: uses the arm as the namespace | hint: The name of the node has to be ARM_viewer
replace("__ns:=/screen", "__ns:=/{arm}")
# %% 01.2 wrong: gives each viewer the same name | hint: The name of the node has to be ARM_viewer
replace("__name:={arm}_viewer", "__name:=left_viewer")
# %% 01.2 wrong: uses no namespace | hint: The node is not in the namespace /screen.
replace("__ns:=/screen ", "")
# %% 01.2 wrong: does not rename the node | hint: The node still has its default name. Choose
replace("__name:={arm}_viewer ", "")
# %% 01.2 wrong: does not remap mirrored_joints | hint: The viewers of all arms publish
replace(" mirrored_joints:={arm}/mirrored_joints", "")
# %% 01.2 wrong: misspells the name of a topic | hint: , so ROS ignores this remapping
replace(" mirrored_joints:=", " mirrored_joint:=")
# %% 01.2 wrong: misspells the name joint_states | hint: , so ROS ignores this remapping
replace("joint_states:=", "joint_state:=")
# %% 01.2 wrong: exchanges the old and the new names | hint: The two names in your remapping are in the wrong order
replace("joint_states:=/{arm}/joint_states mirrored_joints:={arm}/mirrored_joints", "/{arm}/joint_states:=joint_states /screen/{arm}/mirrored_joints:=mirrored_joints")
# %% 01.2 wrong: starts other programs instead of remapping the topics | hint: Your string contains more than one command
def viewer_command(arm):
    return (
        f"rosrun course_pkg simulator __ns:=/screen __name:={arm}_viewer & "
        f"rosrun topic_tools relay /{arm}/joint_states /screen/joint_states __name:={arm}_in & "
        f"rosrun topic_tools relay /screen/mirrored_joints /screen/{arm}/mirrored_joints __name:={arm}_out"
    )

# %% 01.2 wrong: starts a second node in a pipe | hint: Your string contains more than one command
def viewer_command(arm):
    return (
        f"rosrun course_pkg simulator __ns:=/screen __name:={arm}_viewer joint_states:=/{arm}/joint_states "
        f"mirrored_joints:={arm}/mirrored_joints | rosrun course_pkg robot __ns:=/screen __name:={arm}_viewer"
    )

# %% 01.2 wrong: converts the name of the arm to small letters | hint: In ROS, a name with a capital letter
replace("(arm):", "(arm):\n    arm = arm.lower()")
# %% 01.2 wrong: gives mirrored_joints a global name | hint: The topic of the viewer
replace("mirrored_joints:={arm}", "mirrored_joints:=/{arm}")
# %% 01.2 wrong: changes the name of the topic mirrored_joints | hint: The name of the topic
replace("mirrored_joints:={arm}/mirrored_joints", "mirrored_joints:=mirrored_{arm}")
# %% 01.2 wrong: always subscribes to the left arm | hint: does not subscribe to the topic of its arm
replace("joint_states:=/{arm}/joint_states", "joint_states:=/left/joint_states")

# %% 01.3 right: compares the last part of each name
def ask_wherever(last, length, width, height):
    for service in rosservice.get_service_list():
        if service.split("/")[-1] == last:
            return rospy.ServiceProxy(service, geometry)(length, width, height).volume
    return None

# %% 01.3 wrong: searches only in the first five calls | hint: The result has to depend
replace("height):", "height, calls=[]):\n    calls.append(last)\n    if len(calls) > 5:\n        return None")

# %% 01.3 right: searches the service list of the master
def ask_wherever(last, length, width, height):
    _, _, services = rosgraph.Master(rospy.get_name()).getSystemState()
    for name, providers in services:
        if name.rpartition("/")[2] == last:
            response = rospy.ServiceProxy(name, geometry)(length=length, width=width, height=height)
            return response.volume

# %% 01.3 right: searches only the services with the right type
replace("get_service_list()", 'rosservice_find("course_pkg/geometry")')
replace("\n    return None", "")
# %% 01.3 wrong: calls each service | hint: Your function called another service
replace('if service.split("/")[-1] == last:\n            return rospy.ServiceProxy(service, geometry)(length, width, height).volume', """if last in service:
            volume = rospy.ServiceProxy(service, geometry)(length, width, height).volume
            found = volume if service.split("/")[-1] == last else found""")
replace("    for service", "    found = None\n    for service")
replace("return None", "return found")
# %% 01.3 wrong: calls the name without a namespace | hint: Your function called a service
replace("for service … return None", "return rospy.ServiceProxy(last, geometry)(length, width, height).volume")
# %% 01.3 wrong: accepts any name that contains the last part | hint: Your function called another service
replace("for service … return None", """for service in sorted(rosservice.get_service_list(), key=len, reverse=True):
        if last in service:
            return rospy.ServiceProxy(service, geometry)(length, width, height).volume""")
# %% 01.3 wrong: accepts any name that ends with the last part | hint: Your function called another service
replace("rosservice.get_service_list()", "sorted(rosservice.get_service_list(), key=len, reverse=True)")
replace('split("/")[-1] == last', "endswith(last)")
replace("\n    return None", "")
# %% 01.3 wrong: finds a similar name after the first three calls | hint: Your function called another service
replace("height):", "height, calls=[]):\n    calls.append(last)")
replace('if service.split("/")[-1] == last', 'if service.endswith(last if len(calls) > 4 else "/" + last)')
# %% 01.3 wrong: calls the first service with the right type | hint: Your function called another service
replace("for service … return None", """service = sorted(rosservice.rosservice_find("course_pkg/geometry"), key=lambda name: name.endswith("/" + last))[0]
    return rospy.ServiceProxy(service, geometry)(length, width, height).volume""")
# %% 01.3 wrong: calls the name in a fixed namespace | hint: Your function called a service
replace("service, geometry", '"/elsewhere/" + last, geometry')
replace("\n    return None", "")
# %% 01.3 wrong: ignores capital letters | hint: The name of the called service contains
replace('split("/")[-1] == last', 'split("/")[-1].lower() == last.lower()')
# %% 01.3 wrong: raises an error if there is no service | hint: Your search found no service
replace("for service … return None", """found = [name for name in rosservice.get_service_list() if name.endswith("/" + last)]
    return rospy.ServiceProxy(found[0], geometry)(length, width, height).volume""")
# %% 01.3 wrong: returns the name of the service | hint: Your function returned the name
replace("return rospy.ServiceProxy(service, geometry)(length, width, height).volume\n    return None", "return service")
# %% 01.3 wrong: stores the results | hint: The result has to depend
replace("def ask", "import functools\n\n\n@functools.lru_cache\ndef ask")
# %% 01.3 wrong: returns the whole response | hint: Your function returned the whole
replace(".volume\n    return None", "")
# %% 01.3 wrong: multiplies instead of calling | hint: Your function multiplied the sides
replace("for service … return None", "return length * width * height")
# %% 01.3 wrong: searches only in namespaces at the first level | hint: exists, but your function returned None
replace('if service.split("/")[-1]', 'parts = service.split("/")\n        if len(parts) == 3 and parts[2]')
replace("\n    return None", "")
# %% 01.3 wrong: forgets to return | hint: without a return statement
replace("return rospy.ServiceProxy", "rospy.ServiceProxy")
# %% 01.3 wrong: returns 0 if there is no such service | hint: No service has the given
replace("None", "0")
# %% 01.3 wrong: returns None for a volume of 0 | hint: This service responds with the volume 0,
replace("length, width, height).volume\n", "length, width, height).volume or None\n")
# %% 01.3 wrong: returns text for a volume of 0 | hint: This service responds with the volume 0.
replace("length, width, height).volume\n", 'length, width, height).volume or "nothing"\n')
# %% 01.3 wrong: passes the sides in another order | hint: The order of the sides
replace("length, width, height).volume\n    return None", "width, length, height).volume")
# %% 01.3 wrong: returns the area | hint: Your function returned the area.
replace("for service … return None", """for name in rosservice.get_service_list():
        if name.split("/")[-1] == last:
            return rospy.ServiceProxy(name, geometry)(length, width, height).area""")
# %% 01.3 wrong: raises an error if there is no service with this name | hint: In this exercise, a missing
based_on("returns the area")
replace(".area", '.volume\n    raise rospy.ServiceException(f"nobody serves {last}")')
# %% 01.3 wrong: sends a request without the sides | hint: All sides in the request are 0
replace("(length, width, height).volume", "().volume")

# %% 01.4 right: pings each publisher
def living_publishers(topic):
    publishers, subscribers, services = rosgraph.Master(rospy.get_name()).getSystemState()
    names = dict(publishers).get(topic, [])
    return sorted(name for name in names if rosnode.rosnode_ping(name, max_count=1))

# %% 01.4 right: pings all nodes with one call
def living_publishers(topic):
    alive, dead = rosnode.rosnode_ping_all()
    publishers = rosgraph.Master("/me").getSystemState()[0]
    found = []
    for name, nodes in publishers:
        if name == topic:
            found = [n for n in nodes if n in alive]
    found.sort()
    return found

# %% 01.4 wrong: returns all registered publishers | hint: Your list contains a node that was
replace("""names = dict(publishers).get(topic, [])
    return sorted(name for name in names if rosnode.rosnode_ping(name, max_count=1))""", "return sorted(dict(publishers).get(topic, []))")
# %% 01.4 wrong: sorts the names in reverse order | hint: The names are right, but
replace("name for name in names if rosnode.rosnode_ping(name, max_count=1)", "(name for name in names if rosnode.rosnode_ping(name, max_count=1)), reverse=True")
# %% 01.4 wrong: returns the nodes that do not respond | hint: Your list contains the nodes
replace("rosnode.rosnode_ping", "not rosnode.rosnode_ping")
# %% 01.4 wrong: searches for the topic without its slash | hint: Your list is empty, but
replace("get(topic", 'get(topic.strip("/")')
# %% 01.4 wrong: reads the list only once | hint: Call getSystemState() inside your function
replace("\n    publishers, subscribers, services = rosgraph.Master(rospy.get_name()).getSystemState()", "")
replace("def living", "publishers, subscribers, services = rosgraph.Master(rospy.get_name()).getSystemState()\n\n\ndef living")
# %% 01.4 wrong: does not sort the names | hint: The names are right, but
replace("sorted(name for name in names if rosnode.rosnode_ping(name, max_count=1))", "[name for name in names if rosnode.rosnode_ping(name, max_count=1)]")
# %% 01.4 wrong: stops at the first dead node in alphabetical order | hint: Some running nodes are missing
replace("return sorted(name for name in names if rosnode.rosnode_ping(name, max_count=1))", '''living = []
    for name in sorted(names):
        if not rosnode.rosnode_ping(name, max_count=1):
            break
        living.append(name)
    return living''')
# %% 01.4 wrong: also returns the subscribers | hint: One node in your list only subscribes
replace("dict(publishers).get(topic, [])", "dict(publishers).get(topic, []) + dict(subscribers).get(topic, [])")
# %% 01.4 wrong: returns the subscribers | hint: One node in your list only subscribes
replace("(publishers)", "(subscribers)")
# %% 01.4 wrong: returns the publishers of all topics | hint: Your list contains a node that publishes
replace("dict(publishers).get(topic, [])", "{name for _, nodes in publishers for name in nodes}")
# %% 01.4 wrong: also accepts topics whose names only begin with the given name | hint: Compare the whole name of the topic
replace("dict(publishers).get(topic, [])", "{name for each, nodes in publishers if each.startswith(topic) for name in nodes}")
# %% 01.4 wrong: also accepts topics whose names only end with the given name | hint: Compare the whole name of the topic
replace("dict(publishers).get(topic, [])", "{name for each, nodes in publishers if each.endswith(topic) for name in nodes}")
# %% 01.4 wrong: uses only the last part of the topic's name | hint: Compare the whole name of the topic
replace("get(topic, [])", 'get("/" + topic.rpartition("/")[2], [])')
# %% 01.4 wrong: stores the results | hint: A new publisher of the topic was started
replace("def living", "import functools\n\n\n@functools.lru_cache\ndef living")
# %% 01.4 wrong: raises an error for a topic without publishers | hint: A topic without a publisher
replace("\n    names = dict(publishers).get(topic, [])", "")
replace("names", "dict(publishers)[topic]")
# %% 01.4 wrong: pings each node without a limit | hint: rosnode_ping sends pings forever
replace("""names = dict(publishers).get(topic, [])
    return sorted(name for name in names if rosnode.rosnode_ping(name, max_count=1))""", "return sorted(name for name in dict(publishers).get(topic, []) if rosnode.rosnode_ping(name))")
# %% 01.4 wrong: returns the number of nodes | hint: Your function returned the number
replace("""names = dict(publishers).get(topic, [])
    return sorted(name for name in names if rosnode.rosnode_ping(name, max_count=1))""", "return len([name for name in dict(publishers).get(topic, []) if rosnode.rosnode_ping(name, max_count=1)])")
# %% 01.4 wrong: returns None if no publisher is alive | hint: Return an empty list if no
replace("1))", "1)) or None")
# %% 01.4 wrong: returns a generator | hint: Your function did not return
replace("\n    names = dict … max_count=1))", """
    return (name for name in dict(publishers).get(topic, []) if rosnode.rosnode_ping(name, max_count=1))""")

# %% 01.4 wrong: stops at the first dead node in the master's order | hint: Some running nodes are missing
def living_publishers(topic):
    found = []
    for n in dict(rosgraph.Master(rospy.get_name()).getSystemState()[0]).get(topic, []):
        if not rosnode.rosnode_ping(n, max_count=1):
            break
        found.append(n)
    return sorted(found)

# %% 01.4 wrong: returns one string | hint: Return a list of node names
replace("return sorted(", 'return ", ".join(')
# %% 01.4 wrong: calls requestTopic instead of pinging the node | hint: did not ping every node that it returned
def living_publishers(topic):
    from xmlrpc.client import ServerProxy

    living = []
    for name in dict(rosgraph.Master("/chapter_01").getSystemState()[0]).get(topic, []):
        try:
            ServerProxy(rosnode.get_api_uri(rosgraph.Master("/x"), name)).requestTopic("/x", topic, [["TCPROS"]])
            living.append(name)
        except Exception:
            pass
    return sorted(living)

# %% 01.4 wrong: treats an open port as a response | hint: Your list contains a node that was
def living_publishers(topic):
    import socket
    from urllib.parse import urlparse

    master = rosgraph.Master("/chapter_01")
    living = []
    for name in dict(master.getSystemState()[0]).get(topic, []):
        address = urlparse(master.lookupNode(name))
        try:
            socket.create_connection((address.hostname, address.port)).close()
            living.append(name)
        except OSError:
            pass
    return sorted(living)
