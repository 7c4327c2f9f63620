"""What students answer in chapter 01; see answers.py for the form of this file."""

# %% before
import rosgraph
import rosnode
import rospy
import rosservice
from course_pkg import join
from course_pkg.srv import geometry

node = join("chapter_01")

# %% 01.1 right: by its first letter
def full_name(written, namespace, name):
    if written.startswith("/"):
        return written
    room = namespace.rstrip("/")
    if written.startswith("~"):
        return f"{room}/{name}/{written[1:]}"
    return f"{room}/{written}"

# %% 01.1 right: as rospy does
def full_name(written, namespace, name):
    return rospy.resolve_name(written, rosgraph.names.ns_join(namespace, name))

# %% 01.1 right: with the node's full name
def full_name(written, namespace, name):
    node_name = (namespace if namespace != "/" else "") + "/" + name
    if written[0] == "/":
        return written
    elif written[0] == "~":
        return node_name + "/" + written.replace("~", "")
    else:
        return node_name.rsplit("/", 1)[0] + "/" + written

# %% 01.1 wrong: two slashes in the outermost namespace | hint: The outermost namespace is / and ends in one
def full_name(written, namespace, name):
    if written.startswith("/"):
        return written
    if written.startswith("~"):
        return namespace + "/" + name + "/" + written[1:]
    return namespace + "/" + written

# %% 01.1 wrong: a global name is put into the namespace | hint: return it as it is
def full_name(written, namespace, name):
    room = namespace.rstrip("/")
    if written.startswith("~"):
        return f"{room}/{name}/{written[1:]}"
    return f"{room}/{written.lstrip('/')}"

# %% 01.1 wrong: the tilde stays | hint: The ~ is still in it
def full_name(written, namespace, name):
    if written.startswith("/"):
        return written
    if written.startswith("~"):
        return f"{namespace.rstrip('/')}/{name}/{written}"
    return f"{namespace.rstrip('/')}/{written}"

# %% 01.1 wrong: a private name like a relative one | hint: A private name belongs to the node
def full_name(written, namespace, name):
    if written.startswith("/"):
        return written
    return f"{namespace.rstrip('/')}/{written.lstrip('~')}"

# %% 01.1 wrong: a private name outside of the namespace | hint: The node stands in a namespace itself
def full_name(written, namespace, name):
    if written.startswith("/"):
        return written
    if written.startswith("~"):
        return f"/{name}/{written[1:]}"
    return f"{namespace.rstrip('/')}/{written}"

# %% 01.1 wrong: everything under the node | hint: Only a private name goes under the name of the node
def full_name(written, namespace, name):
    if written.startswith("/"):
        return written
    return f"{namespace.rstrip('/')}/{name}/{written.lstrip('~')}"

# %% 01.1 wrong: without the namespace | hint: The namespace is missing
def full_name(written, namespace, name):
    if written.startswith("/"):
        return written
    if written.startswith("~"):
        return f"{namespace.rstrip('/')}/{name}/{written[1:]}"
    return f"/{written}"

# %% 01.1 wrong: no slash in front | hint: A full name starts with a slash
def full_name(written, namespace, name):
    if written.startswith("/"):
        return written
    if written.startswith("~"):
        return f"{namespace}/{name}/{written[1:]}".lstrip("/")
    return f"{namespace}/{written}".lstrip("/")

# %% 01.1 wrong: no slash between | hint: A slash is missing between
def full_name(written, namespace, name):
    if written.startswith("/"):
        return written
    if written.startswith("~"):
        return namespace + name + "/" + written[1:]
    return namespace + written

# %% 01.1 wrong: as this notebook means it | hint: The node in question is another
def full_name(written, namespace, name):
    return rospy.resolve_name(written)

# %% 01.1 wrong: prints it | hint: without a return line
def full_name(written, namespace, name):
    print(rospy.resolve_name(written, f"{namespace}/{name}"))

# %% 01.1 wrong: any slash makes it global | hint: Only a slash in front makes a name global
def full_name(written, namespace, name):
    room = namespace.rstrip("/")
    if "/" in written and not written.startswith("~"):
        return written
    if written.startswith("~"):
        return f"{room}/{name}/{written[1:]}"
    return f"{room}/{written}"

# %% 01.1 wrong: the last part only | hint: All of them stay
def full_name(written, namespace, name):
    room = namespace.rstrip("/")
    if written.startswith("/"):
        return written
    last = written.lstrip("~").split("/")[-1]
    if written.startswith("~"):
        return f"{room}/{name}/{last}"
    return f"{room}/{last}"

# %% 01.1 wrong: the namespace goes in twice | hint: the whole namespace of the node, once
def full_name(written, namespace, name):
    room = namespace.rstrip("/")
    if written.startswith("/"):
        return written
    if written.startswith("~"):
        return f"{room}{room}/{name}/{written[1:]}"
    return f"{room}{room}/{written}"

# %% 01.1 wrong: name before namespace | hint: The namespace comes first
def full_name(written, namespace, name):
    if written.startswith("/"):
        return written
    room = namespace.rstrip("/")
    if written.startswith("~"):
        return f"/{name}{room}/{written[1:]}"
    return f"{room}/{written}"

# %% 01.2 right: a namespace and two new names
def start_in(room):
    return node.run("course_pkg", "server", f"__ns:=/{room}", "__name:=measurer", "getGeometry:=measure")

# %% 01.2 right: every name written out
def start_in(room):
    return node.run("course_pkg", "server", f"__name:=/{room}/measurer", f"getGeometry:=/{room}/measure")

# %% 01.2 right: name as an argument of node.run
def start_in(room):
    process = node.run("course_pkg", "server", "__ns:=" + room, "getGeometry:=measure", name="measurer")
    process.wait_for_service(f"/{room}/measure", timeout=10)
    return process

# %% 01.2 wrong: a global name | hint: With a slash in front it is global
def start_in(room):
    return node.run("course_pkg", "server", f"__ns:=/{room}", "__name:=measurer", "getGeometry:=/measure")

# %% 01.2 wrong: no namespace | hint: It is /measure for every room
def start_in(room):
    return node.run("course_pkg", "server", "__name:=measurer", "getGeometry:=measure")

# %% 01.2 wrong: the service is not renamed | hint: It is in its room, and has kept its name
def start_in(room):
    return node.run("course_pkg", "server", f"__ns:=/{room}", "__name:=measurer")

# %% 01.2 wrong: the wrong way round | hint: The old name comes first
def start_in(room):
    return node.run("course_pkg", "server", f"__ns:=/{room}", "__name:=measurer", "measure:=getGeometry")

# %% 01.2 wrong: the node is not renamed | hint: That is the name that the program proposes
def start_in(room):
    return node.run("course_pkg", "server", f"__ns:=/{room}", "getGeometry:=measure")

# %% 01.2 wrong: only the service goes into the room | hint: The node is not in the namespace of the room
def start_in(room):
    return node.run("course_pkg", "server", "__name:=measurer", f"getGeometry:=/{room}/measure")

# %% 01.2 wrong: always the kitchen | hint: The room that the function is given is the namespace
def start_in(room):
    return node.run("course_pkg", "server", "__ns:=/kitchen", "__name:=measurer", "getGeometry:=measure")

# %% 01.2 wrong: an equals sign alone | hint: Its name and place are as ever
def start_in(room):
    return node.run("course_pkg", "server", f"__ns=/{room}", "__name=measurer", "getGeometry=measure")

# %% 01.2 wrong: blanks around the sign | hint: Its name and place are as ever
def start_in(room):
    return node.run("course_pkg", "server", "__ns", ":=", f"/{room}", "getGeometry", ":=", "measure")

# %% 01.2 wrong: another program | hint: The program that serves one is server
def start_in(room):
    return node.run("course_pkg", "pulse", f"__ns:=/{room}", "__name:=measurer", "getGeometry:=measure")

# %% 01.2 wrong: forgets to return | hint: Return what node.run returns
def start_in(room):
    node.run("course_pkg", "server", f"__ns:=/{room}", "__name:=measurer", "getGeometry:=measure")

# %% 01.3 right: the last part of each name
def ask_wherever(last, length, width, height):
    for service in rosservice.get_service_list():
        if service.split("/")[-1] == last:
            return node.call(service, geometry, length, width, height).volume
    return None

# %% 01.3 right: by its end, slash and all
def ask_wherever(last, length, width, height):
    found = [name for name in rosservice.get_service_list() if name.endswith("/" + last)]
    if not found:
        return None
    proxy = rospy.ServiceProxy(found[0], geometry)
    return proxy(length, width, height).volume

# %% 01.3 right: from the lists of the master
def ask_wherever(last, length, width, height):
    _, _, services = rosgraph.Master(node.name).getSystemState()
    for name, providers in services:
        if name.rpartition("/")[2] == last:
            response = node.call(name, geometry, length=length, width=width, height=height)
            return response.volume

# %% 01.3 right: among those of the type
def ask_wherever(last, length, width, height):
    for service in rosservice.rosservice_find("course_pkg/geometry"):
        if service.split("/")[-1] == last:
            return node.call(service, geometry, length, width, height).volume

# %% 01.3 wrong: only in the outermost namespace | hint: The name that was called is not the full one
def ask_wherever(last, length, width, height):
    return node.call(last, geometry, length, width, height).volume

# %% 01.3 wrong: any name that contains it | hint: whose name only looks like it
def ask_wherever(last, length, width, height):
    for service in sorted(rosservice.get_service_list(), key=len, reverse=True):
        if last in service:
            return node.call(service, geometry, length, width, height).volume

# %% 01.3 wrong: ends with it, without the slash | hint: Compare all that stands behind the last slash
def ask_wherever(last, length, width, height):
    for service in sorted(rosservice.get_service_list(), key=len, reverse=True):
        if service.endswith(last):
            return node.call(service, geometry, length, width, height).volume

# %% 01.3 wrong: the first of the type | hint: whose name only looks like it
def ask_wherever(last, length, width, height):
    service = sorted(rosservice.rosservice_find("course_pkg/geometry"), key=lambda name: name.endswith("/" + last))[0]
    return node.call(service, geometry, length, width, height).volume

# %% 01.3 wrong: calls the last part | hint: Call the service by the name that you found
def ask_wherever(last, length, width, height):
    for service in rosservice.get_service_list():
        if service.split("/")[-1] == last:
            return node.call("/elsewhere/" + last, geometry, length, width, height).volume

# %% 01.3 wrong: nobody is an error | hint: Return None then
def ask_wherever(last, length, width, height):
    found = [name for name in rosservice.get_service_list() if name.endswith("/" + last)]
    return node.call(found[0], geometry, length, width, height).volume

# %% 01.3 wrong: returns the name | hint: That is its name
def ask_wherever(last, length, width, height):
    for service in rosservice.get_service_list():
        if service.split("/")[-1] == last:
            return service

# %% 01.3 wrong: returns the response | hint: That is the whole response
def ask_wherever(last, length, width, height):
    for service in rosservice.get_service_list():
        if service.split("/")[-1] == last:
            return node.call(service, geometry, length, width, height)

# %% 01.3 wrong: multiplies | hint: You multiplied
def ask_wherever(last, length, width, height):
    return length * width * height

# %% 01.3 wrong: only one namespace deep | hint: Look through all names
def ask_wherever(last, length, width, height):
    for service in rosservice.get_service_list():
        parts = service.split("/")
        if len(parts) == 3 and parts[2] == last:
            return node.call(service, geometry, length, width, height).volume

# %% 01.3 wrong: 0 when there is none | hint: Return None after the search
def ask_wherever(last, length, width, height):
    for service in rosservice.get_service_list():
        if service.split("/")[-1] == last:
            return node.call(service, geometry, length, width, height).volume
    return 0

# %% 01.3 wrong: another order | hint: order of your arguments
def ask_wherever(last, length, width, height):
    for service in rosservice.get_service_list():
        if service.split("/")[-1] == last:
            return node.call(service, geometry, width, length, height).volume

# %% 01.3 wrong: the area | hint: That is the area
def ask_wherever(last, length, width, height):
    for name in rosservice.get_service_list():
        if name.split("/")[-1] == last:
            return node.call(name, geometry, length, width, height).area

# %% 01.3 wrong: an error for nobody | hint: that is no error here
def ask_wherever(last, length, width, height):
    for name in rosservice.get_service_list():
        if name.split("/")[-1] == last:
            return node.call(name, geometry, length, width, height).volume
    raise rospy.ServiceException(f"nobody serves {last}")

# %% 01.4 right: ping each
def living_publishers(topic):
    publishers, subscribers, services = rosgraph.Master(node.name).getSystemState()
    names = dict(publishers).get(topic, [])
    return sorted(name for name in names if rosnode.rosnode_ping(name, max_count=1))

# %% 01.4 right: ping all at once
def living_publishers(topic):
    alive, dead = rosnode.rosnode_ping_all()
    publishers = rosgraph.Master("/me").getSystemState()[0]
    found = []
    for name, nodes in publishers:
        if name == topic:
            found = [n for n in nodes if n in alive]
    found.sort()
    return found

# %% 01.4 wrong: all that are listed | hint: One of those was killed
def living_publishers(topic):
    publishers, subscribers, services = rosgraph.Master(node.name).getSystemState()
    return sorted(dict(publishers).get(topic, []))

# %% 01.4 wrong: not sorted | hint: Return them sorted
def living_publishers(topic):
    publishers, subscribers, services = rosgraph.Master(node.name).getSystemState()
    names = dict(publishers).get(topic, [])
    return sorted((name for name in names if rosnode.rosnode_ping(name, max_count=1)), reverse=True)

# %% 01.4 wrong: the dead | hint: Those are the dead ones
def living_publishers(topic):
    publishers, subscribers, services = rosgraph.Master(node.name).getSystemState()
    names = dict(publishers).get(topic, [])
    return sorted(name for name in names if not rosnode.rosnode_ping(name, max_count=1))

# %% 01.4 wrong: the subscribers | hint: Somebody publishes it
def living_publishers(topic):
    publishers, subscribers, services = rosgraph.Master(node.name).getSystemState()
    names = dict(subscribers).get(topic, [])
    return sorted(name for name in names if rosnode.rosnode_ping(name, max_count=1))

# %% 01.4 wrong: everybody who publishes anything | hint: One of those publishes another topic
def living_publishers(topic):
    publishers, subscribers, services = rosgraph.Master(node.name).getSystemState()
    names = {name for _, nodes in publishers for name in nodes}
    return sorted(name for name in names if rosnode.rosnode_ping(name, max_count=1))

# %% 01.4 wrong: a topic that is in no list | hint: No node has ever published that topic
def living_publishers(topic):
    publishers, subscribers, services = rosgraph.Master(node.name).getSystemState()
    return sorted(name for name in dict(publishers)[topic] if rosnode.rosnode_ping(name, max_count=1))

# %% 01.4 wrong: pings for ever | hint: Without max_count=1
def living_publishers(topic):
    publishers, subscribers, services = rosgraph.Master(node.name).getSystemState()
    return sorted(name for name in dict(publishers).get(topic, []) if rosnode.rosnode_ping(name))

# %% 01.4 wrong: how many there are | hint: That is how many there are
def living_publishers(topic):
    publishers, subscribers, services = rosgraph.Master(node.name).getSystemState()
    return len([name for name in dict(publishers).get(topic, []) if rosnode.rosnode_ping(name, max_count=1)])

# %% 01.4 wrong: None for nobody | hint: None is no list
def living_publishers(topic):
    publishers, subscribers, services = rosgraph.Master(node.name).getSystemState()
    names = dict(publishers).get(topic, [])
    return sorted(name for name in names if rosnode.rosnode_ping(name, max_count=1)) or None

# %% 01.4 wrong: a generator | hint: That is no list
def living_publishers(topic):
    publishers, subscribers, services = rosgraph.Master(node.name).getSystemState()
    return (name for name in dict(publishers).get(topic, []) if rosnode.rosnode_ping(name, max_count=1))

# %% 01.4 right: three pings each
def living_publishers(topic):
    result = []
    for name, nodes in rosgraph.Master(node.name).getSystemState()[0]:
        if name == topic:
            for each in nodes:
                if rosnode.rosnode_ping(each, max_count=3, verbose=False):
                    result.append(each)
    return sorted(result)

# %% 01.4 wrong: stops at the first dead one | hint: Some who live are missing
def living_publishers(topic):
    found = []
    for n in dict(rosgraph.Master(node.name).getSystemState()[0]).get(topic, []):
        if not rosnode.rosnode_ping(n, max_count=1):
            break
        found.append(n)
    return sorted(found)
