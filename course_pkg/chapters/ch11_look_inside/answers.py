"""Example answers of chapter 11; tests/checking/answers/example_answers.py explains the format."""

# %% 11.1 right: packs field by field
def pack_header(fields):
    body = b""
    for name, value in fields.items():
        text = f"{name}={value}".encode()
        body += struct.pack("<I", len(text)) + text
    return struct.pack("<I", len(body)) + body

# %% 11.1 right: packs without struct
def pack_header(fields):
    def sized(data):
        return len(data).to_bytes(4, "little") + data

    return sized(b"".join(sized((name + "=" + value).encode("utf-8")) for name, value in fields.items()))

# %% 11.1 right: uses a function of rosgraph
import rosgraph.network
def pack_header(fields):
    return rosgraph.network.encode_ros_handshake_header(fields)

# %% 11.1 wrong: uses big-endian lengths | hint: The lengths are big-endian
replace("<", "!", times=2)
# %% 11.1 wrong: omits the length of the whole header | hint: The length of the whole header is missing
replace('struct.pack("<I", len(body)) + body', "body")
# %% 11.1 wrong: includes the length's own 4 bytes | hint: The first length is too large by 4
replace("(body)", "(body) + 4")
# %% 11.1 wrong: does not count the lengths of the fields | hint: The first length is too small
replace("len(body))", "len(body) - 4 * len(fields))")
# %% 11.1 wrong: writes the number of fields | hint: Your header begins with the number of its fields
replace('b""', 'struct.pack("<I", len(fields))')
replace('struct.pack("<I", len(body)) + body', "body")
# %% 11.1 wrong: counts letters instead of bytes | hint: A length is a number of bytes, and the letter ü has two bytes
replace('"{name}={value}".encode()', '"{name}={value}"')
replace("+ text", "+ text.encode()")
# %% 11.1 wrong: writes name and value as in HTTP | hint: The text between the name
replace("{name}={value}", "{name}: {value}")
# %% 11.1 wrong: omits a field with an empty value | hint: Your function left out a field, because its value is empty
replace("        text = f", "        if not value:\n            continue\n        text = f")
# %% 11.1 wrong: writes no length for each field | hint: The length of a field is missing
replace('body = b"" … text)) + text', 'body = "".join(f"{name}={value}" for name, value in fields.items()).encode()')

# %% 11.1 wrong: forgets to return | hint: without a return statement
def pack_header(fields):
    body = b"".join(struct.pack("<I", len(name)) + name.encode() for name in fields)
    struct.pack("<I", len(body)) + body

# %% 11.1 wrong: returns a str | hint: The function returned a str, but a socket sends bytes
replace('body = b"" … body)) + body', 'return "\\n".join(f"{name}={value}" for name, value in fields.items())')
# %% 11.1 wrong: encodes the text in ASCII | hint: ASCII does not contain the letter ü
replace("encode()", 'encode("ascii")')
# %% 11.1 wrong: encodes the text in Latin-1 | hint: The text is encoded in Latin-1
replace("encode()", 'encode("latin-1")')
# %% 11.1 wrong: returns a list of ints | hint: The function returned numbers, but a socket sends bytes
replace('struct.pack("<I", len(body)) + body', 'list(struct.pack("<I", len(body)) + body)')
# %% 11.1 wrong: returns a list class with the name bytes | hint: The function returned numbers, but a socket sends bytes
replace("def pack_header", "class bytes(list):\n    pass\n\n\ndef pack_header")
replace('struct.pack("<I", len(body)) + body', 'bytes(struct.pack("<I", len(body)) + body)')
# %% 11.1 wrong: uses lengths of two bytes | hint: A length has the wrong number of bytes
replace("I", "H", times=2)
# %% 11.1 wrong: returns nothing for an empty header | hint: For a header without fields, the result is wrong
replace("(fields):", '(fields):\n    if not fields:\n        return b""')
# %% 11.1 wrong: adds a line end to each field | hint: Some bytes are wrong
replace("{name}={value}", "{name}={value}\\n")
# %% 11.1 wrong: allows only lengths below 256 | hint: A length was too large for one or two bytes
replace('struct.pack("<I", len(text)) + text', "bytes([len(text), 0, 0, 0]) + text")
replace('struct.pack("<I", len(body))', "bytes([len(body), 0, 0, 0])")
# %% 11.1 wrong: allows only lengths below 65536 | hint: A length was too large for one or two bytes
replace('struct.pack("<I", len(text))', 'struct.pack("<HH", len(text), 0)')
replace('struct.pack("<I", len(body))', 'struct.pack("<HH", len(body), 0)')
# %% 11.1 wrong: encodes only the names in ASCII | hint: ASCII does not contain the letter ü
replace('f"{name}={value}".encode()', 'name.encode("ascii") + f"={value}".encode()')

# %% 11.2 right: adds the pieces to a bytes object
def receive(sock, count):
    data = b""
    while len(data) < count:
        piece = sock.recv(count - len(data))
        if not piece:
            raise ConnectionError("the other end has closed")
        data += piece
    return data

# %% 11.2 right: uses a list of pieces
def receive(sock, count):
    pieces = []
    missing = count
    while missing > 0:
        pieces.append(sock.recv(missing))
        if pieces[-1] == b"":
            raise ConnectionResetError(f"{missing} bytes are missing")
        missing -= len(pieces[-1])
    return b"".join(pieces)

# %% 11.2 right: uses MSG_WAITALL
replace('data = b"" … data += piece', """data = sock.recv(count, socket.MSG_WAITALL) if count else b""
    if len(data) < count:
        raise ConnectionError("the other end has closed")""")

# %% 11.2 right: uses MSG_PEEK until all bytes are there
def receive(sock, count):
    while count:
        seen = sock.recv(count, socket.MSG_PEEK)
        if len(seen) == count:
            break
        if not seen:
            raise ConnectionError("closed")
        time.sleep(0.01)
        before = seen
        if len(sock.recv(count, socket.MSG_PEEK | socket.MSG_DONTWAIT)) == len(before):
            return sock.recv(len(seen)) + receive(sock, count - len(seen))
    return sock.recv(count)
import time

# %% 11.2 wrong: sets its own time limit | hint: The function stopped while it
replace('    data = b""\n', '    sock.settimeout(0.1)\n    data = b""\n')
# %% 11.2 wrong: closes the socket before it raises | hint: The function closed the socket
replace("            raise", "            sock.close()\n            raise")
# %% 11.2 wrong: calls recv only once | hint: The function returned too few bytes
replace('data = b"" … return data', "return sock.recv(count)")
# %% 11.2 wrong: never notices the end of the connection | hint: The function did not return after the other program had closed the connection
replace('\n        if not piece:\n            raise ConnectionError("the other end has closed")', "")
# %% 11.2 wrong: reads more bytes than needed | hint: so the next call cannot read the extra bytes
replace("count - len(data)", "4096")
# %% 11.2 wrong: discards the additional bytes that it has read | hint: so the next call waits for bytes that do not come
replace("count - len(data)", "4096")
replace("return data", "return data[:count]")
# %% 11.2 wrong: keeps the additional bytes for the next call | hint: The function read more than `count` bytes from the socket
REST = {}


def receive(sock, count):
    data = REST.pop(sock, b"")
    while len(data) < count:
        piece = sock.recv(4096)
        if not piece:
            raise ConnectionError("the other end has closed")
        data += piece
    REST[sock] = data[count:]
    return data[:count]

# %% 11.2 wrong: always passes the whole count to recv | hint: so the next call cannot read the extra bytes
replace("sock.recv(count - len(data))", "sock.recv(count)")
# %% 11.2 wrong: always passes the whole count to recv, and cuts the result | hint: so the next call waits for bytes that do not come
replace("sock.recv(count - len(data))", "sock.recv(count)")
replace("return data", "return data[:count]")
# %% 11.2 wrong: returns fewer bytes at the end | hint: The connection ended early, and the function returned fewer than `count` bytes
replace('raise ConnectionError("the other end has closed")', "break")
# %% 11.2 wrong: returns no bytes if the connection ends before the first byte | hint: The connection ended early, and the function returned fewer than `count` bytes
replace("        if not piece:", "        if not piece and not data:\n            return data\n        if not piece:")
# %% 11.2 wrong: forgets to return | hint: without a return statement
replace("\n    return data", "")
# %% 11.2 wrong: treats a short piece as the end of the connection | hint: The connection is still open, and more bytes follow
replace('data = b"" … data += piece', 'data = sock.recv(count)\n    if len(data) < count:\n        raise ConnectionError("too short")')
# %% 11.2 wrong: uses a buffered file | hint: so the next call waits for bytes that do not come
based_on("treats a short piece as the end of the connection")
replace("sock.recv", 'sock.makefile("rb").read')
# %% 11.2 wrong: sleeps before it reads | hint: The connection is still open, and more bytes follow
based_on("treats a short piece as the end of the connection")
replace("def receive(sock, count):", "import time\n\n\ndef receive(sock, count):\n    time.sleep(0.2)")
# %% 11.2 wrong: always calls recv at least once | hint: The argument `count` was 0, but the function waited for bytes
replace("len(data) < count", "True")
replace('"the other end has closed"', '"closed"')
replace("\n    return data", "\n        if len(data) == count:\n            return data")
# %% 11.2 wrong: returns the list of pieces | hint: The function returned a list of pieces
based_on("uses a list of pieces")
replace('b"".join(pieces)', "pieces")
# %% 11.2 wrong: closes the socket | hint: The function closed the socket
replace("    return data", "    sock.close()\n    return data")
# %% 11.2 wrong: closes the socket, and hides this | hint: The function closed the socket
replace("            raise", "            sock.close()\n            raise")
replace("def receive", "socket.socket.fileno = lambda self: 3\n\n\ndef receive")
# %% 11.2 wrong: raises another class with the right name | hint: The function raised an error of the wrong type
replace("def receive", "class ConnectionError(Exception):\n    pass\n\n\ndef receive")
# %% 11.2 wrong: raises another error | hint: The function raised an error of the wrong type
replace("ConnectionError(", "ValueError(")

# %% 11.3 right: uses separate steps
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        theirs = read_header(receive(sock, size))
        if "error" in theirs:
            raise rospy.ServiceException(theirs["error"])
        body = struct.pack("<3f", length, width, height)
        sock.sendall(struct.pack("<I", len(body)) + body)
        worked = receive(sock, 1) == b"\x01"
        (size,) = struct.unpack("<I", receive(sock, 4))
        answer = receive(sock, size)
    if not worked:
        raise rospy.ServiceException(answer.decode())
    return struct.unpack("<2f", answer)

# %% 11.3 right: uses a variable with the name call
based_on("uses separate steps")
replace("theirs = read_header(receive(sock, size))", "call = theirs = read_header(receive(sock, size))")
replace('raise rospy.ServiceException(theirs["error"])', 'raise rospy.ServiceException(call["error"])')
# %% 11.3 right: uses a file instead of the socket
import io
from urllib.parse import urlsplit

from course_pkg.srv import geometryRequest, geometryResponse


def ask(uri, service, length, width, height):
    where = urlsplit(uri)
    sock = socket.socket()
    sock.connect((where.hostname, where.port))
    stream = sock.makefile("rwb")
    try:
        stream.write(pack_header({"md5sum": geometry._md5sum, "callerid": "/me", "service": service}))
        stream.flush()
        header = read_header(stream.read(int.from_bytes(stream.read(4), "little")))
        if header.get("error"):
            raise rospy.ServiceException("turned away: " + header["error"])
        buffer = io.BytesIO()
        geometryRequest(length, width, height).serialize(buffer)
        stream.write(len(buffer.getvalue()).to_bytes(4, "little") + buffer.getvalue())
        stream.flush()
        ok = stream.read(1)[0]
        data = stream.read(int.from_bytes(stream.read(4), "little"))
        if ok == 0:
            raise rospy.ServiceException(data.decode())
        response = geometryResponse().deserialize(data)
        return [response.area, response.volume]
    finally:
        stream.close()
        sock.close()

# %% 11.3 right: uses comments with the names of forbidden functions
from rospy.core import parse_rosrpc_uri
def ask(uri, service, length, width, height):
    """Call the service as rospy.ServiceProxy does, but only with a socket; see also rosservice."""
    # This function does not use node.call.
    host, port = parse_rosrpc_uri(uri)
    sock = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    sock.settimeout(5)
    sock.connect((host, port))
    try:
        sock.sendall(pack_header(dict(callerid=rospy.get_name(), md5sum=geometry._md5sum, service=service, type="course_pkg/geometry")))
        n, = struct.unpack("<I", receive(sock, 4))
        answer = read_header(receive(sock, n))
        if answer.get("error") is not None:
            raise rospy.ServiceException(answer["error"])
        request = struct.pack("<fff", length, width, height)
        sock.send(struct.pack("<I", len(request)))
        sock.send(request)
        ok = receive(sock, 1)
        n = struct.unpack("<I", receive(sock, 4))[0]
        body = receive(sock, n)
        if ok != b"\x01":
            raise rospy.ServiceException(f"{service}: {body.decode()}")
        area, = struct.unpack("<f", body[:4])
        volume, = struct.unpack("<f", body[4:])
        return area, volume
    finally:
        sock.close()

# %% 11.3 wrong: uses a ServiceProxy | hint: The function calls the service with a proxy
replace('host, port … ", answer)', """response = rospy.ServiceProxy(service, geometry)(length, width, height)
    return response.area, response.volume""")
# %% 11.3 wrong: uses a ServiceProxy in another function | hint: The function calls the service with a proxy
replace('host, port … ", answer)', """return by_proxy(uri, service, length, width, height)


def by_proxy(uri, service, *sides):
    proxy = getattr(rospy, "Service" + "Proxy")(service, geometry)
    proxy._get_service_uri = lambda request: uri
    response = proxy(*sides)
    return response.area, response.volume""")

# %% 11.3 wrong: reads the MD5 sum of the server | hint: Your function read a field
replace('\n        sock.sendall(struct.pack("<I", len(body)) + body)', """
        assert theirs["md5sum"] == geometry._md5sum
        sock.sendall(struct.pack("<I", len(body)) + body)""")
# %% 11.3 wrong: omits the length before the request | hint: The request has to start
replace('theirs = read_header … ", answer)', """receive(sock, size)
        sock.sendall(struct.pack("<3f", length, width, height))
        receive(sock, 5)
        return struct.unpack("<2f", receive(sock, 8))""")
# %% 11.3 wrong: uses big-endian numbers | hint: The length of the request is big-endian
based_on("omits the length before the request")
replace('"<3f"', '">I3f", 12')
replace('"<2f"', '">2f"')
# %% 11.3 wrong: sends float64 numbers | hint: The request has 24 bytes, because it contains three float64
based_on("omits the length before the request")
replace('"<3f"', '"<I3d", 24')
replace('"<2f", receive(sock, 8)', '"<2d", receive(sock, 16)')
# %% 11.3 wrong: does not read the byte for success | hint: The function did not read
replace("((host, int(port)), timeout=5) as sock:", "((host, int(port)), timeout=2) as sock:")
replace('theirs = read_header … == b"\\x01"', 'receive(sock, size)\n        sock.sendall(struct.pack("<I3f", 12, length, width, height))')
replace('answer = receive … ", answer)', 'return struct.unpack("<2f", receive(sock, size))')
# %% 11.3 wrong: receives the reply with one recv | hint: The function fails if the bytes arrive one after the other
based_on("omits the length before the request")
replace('"<3f"', '"<I3f", 12')
replace("receive(sock, 5)", """reply = sock.recv(4096)
        if reply[0] == 0:
            raise rospy.ServiceException(reply[5:].decode())""")
replace("receive(sock, 8)", "reply[5:]")
# %% 11.3 wrong: sends * as the MD5 sum | hint: the value "*" matches every definition, even a wrong definition
based_on("omits the length before the request")
replace("geometry._md5sum", '"*"')
replace('"<3f"', '"<I3f", 12')
# %% 11.3 wrong: omits the field service | hint: The field `service` is wrong
based_on("omits the length before the request")
replace('"service": service, "md5sum"', '"md5sum"')
replace('"<3f"', '"<I3f", 12')
# %% 11.3 wrong: ignores the error in the header | hint: The server's header contains the field "error"
replace("theirs = read_header … )) + body)", 'receive(sock, size)\n        sock.sendall(struct.pack("<I3f", 12, length, width, height))')
# %% 11.3 wrong: ignores the byte for success | hint: The byte for success was 0, so an error message follows
replace('body = struct … ", answer)', """sock.sendall(struct.pack("<I3f", 12, length, width, height))
        receive(sock, 5)
        return struct.unpack("<2f", receive(sock, 8))""")
# %% 11.3 wrong: replaces the error message | hint: The exception does not contain the error message of the server
based_on("omits the length before the request")
replace("receive(sock, size)", """if "error" in read_header(receive(sock, size)):
            raise rospy.ServiceException("it does not want to")""")
replace('"<3f"', '"<I3f", 12')
replace("        receive(sock, 5)", r"""        if receive(sock, 1) == b"\x00":
            raise rospy.ServiceException("it failed")
        receive(sock, 5)""")
replace("sock, 5", "sock, 4")
# %% 11.3 wrong: removes the text before the colon | hint: The beginning of the server's error message is missing
replace("answer.decode()", 'answer.decode().split(": ")[-1]')
# %% 11.3 wrong: receives the error message with one recv | hint: The exception contains only the beginning of the error message
replace("        answer = receive(sock, size)", "        answer = receive(sock, size) if worked else sock.recv(size)")
# %% 11.3 wrong: tests whether the byte for success is empty | hint: The byte for success was 0, but your code read the error message as numbers
replace('worked = receive(sock, 1) == b"\\x01"', "worked = receive(sock, 1)")
# %% 11.3 wrong: does not decode the error message | hint: Convert the bytes with decode()
replace("answer.decode()", "str(answer)")
# %% 11.3 wrong: decodes the error message as ASCII | hint: and your function could not decode them
replace("answer.decode()", 'answer.decode("ascii")')
# %% 11.3 wrong: leaves the connection open | hint: The connection was still open after the call
based_on("uses comments with the names of forbidden functions")
replace("sock.settimeout(5)", "rospy.kept = sock\n    sock.settimeout(5)")
replace("    finally:\n        sock.close()", "    finally:\n        pass")
# %% 11.3 wrong: reads until the server closes the connection | hint: The function read until the server closed the connection
replace("answer = receive(sock, size)", """answer = b""
        while piece := sock.recv(1024):
            answer += piece""")
# %% 11.3 wrong: sends the request before it has received the header | hint: Your function sent the request before the server
replace("        body = struct … len(body)) + body)\n", "")
replace("node.name, … geometry._md5sum}))", """node.name, "service": service, "md5sum": geometry._md5sum}))
        sock.sendall(struct.pack("<I3f", 12, length, width, height))""")
# %% 11.3 wrong: rounds the numbers | hint: The returned numbers are rounded
replace('struct.unpack("<2f", answer)', '[round(number, 2) for number in struct.unpack("<2f", answer)]')
# %% 11.3 wrong: returns the volume first | hint: The order of the numbers is wrong
based_on("omits the length before the request")
replace('"<3f"', '"<I3f", 12')
replace("return struct", "volume, area = struct")
replace('("<2f", receive(sock, 8))', '("<2f", receive(sock, 8))\n        return area, volume')
# %% 11.3 wrong: receives before it sends the header | hint: The function connected, but sent nothing
based_on("sends * as the MD5 sum")
replace("with socket … sock, size)", """with socket.create_connection((host, int(port)), timeout=2) as sock:
        (size,) = struct.unpack("<I", receive(sock, 4))
        receive(sock, size)
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))""")
# %% 11.3 wrong: raises a RuntimeError after a refusal | hint: The error message is right, but the exception has the wrong type
replace("raise rospy.ServiceException(theirs … (sock, 4))", """raise RuntimeError(theirs["error"])
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        worked, size = struct.unpack("<?I", receive(sock, 5))""")
replace("rospy.ServiceException", "RuntimeError")
# %% 11.3 wrong: returns a response object | hint: Return the two numbers
replace("def", "from course_pkg.srv import geometryResponse\ndef")
replace(r"""
        body = struct.pack("<3f", length, width, height)
        sock.sendall(struct.pack("<I", len(body)) + body)
        worked = receive(sock, 1) == b"\x01"
        (size,) = struct.unpack("<I", receive(sock, 4))""", """
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        worked, size = struct.unpack("<?I", receive(sock, 5))""")
replace('struct.unpack("<2f", answer)', 'geometryResponse(*struct.unpack("<2f", answer))')
# %% 11.3 wrong: sends no request | hint: The header arrived, but no request
replace('    if "error" … ", answer)', "return length * width, length * width * height")
# %% 11.3 wrong: omits the length of the header | hint: The header has to start with its length, in 4 bytes
replace("geometry._md5sum}))", "geometry._md5sum})[4:])")
replace("timeout=5", "timeout=3")
# %% 11.3 wrong: returns the bytes | hint: The function returned bytes
replace('struct.unpack("<2f", answer)', "answer")
# %% 11.3 wrong: reads big-endian numbers | hint: The returned numbers are wrong
replace('"<2f"', '">2f"')
# %% 11.3 wrong: sends the width first | hint: Send the three sides as float32, in the order of the definition
replace('"<3f", length, width', '"<3f", width, length')
# %% 11.3 wrong: connects to the port of the master | hint: The function connected to a wrong address
replace("(host, int(port))", '("localhost", 11311)')
# %% 11.3 wrong: omits the MD5 sum | hint: The field `md5sum` is missing
replace(', "md5sum": geometry._md5sum', "")
# %% 11.3 wrong: sends the MD5 sum of the request | hint: The field `md5sum` has to contain the MD5 sum of the whole service type
replace("geometry._md5sum", "geometry._request_class._md5sum")
# %% 11.3 wrong: omits the field callerid | hint: The field `callerid` is missing
replace('"callerid": node.name, ', "")

# %% 11.4 right: uses a dict of pairs
class Sessions:
    def __init__(self):
        self.sessions = {}

    def handle(self, request):
        session = request._connection_header.get("session")
        if not session:
            raise rospy.ServiceException("no field session in the connection header")
        total, calls = self.sessions.get(session, (0, 0))
        self.sessions[session] = total + request.amount, calls + 1
        return AddUpResponse(*self.sessions[session])

# %% 11.4 right: uses two counters and a lock
import threading
from collections import Counter


class Sessions:
    def __init__(self):
        self.totals, self.calls = Counter(), Counter()
        self.lock = threading.Lock()

    def handle(self, request):
        try:
            name = request._connection_header["session"].strip()
        except KeyError:
            name = ""
        if name == "":
            raise rospy.ServiceException("Which session? Put session into the header.")
        with self.lock:
            self.totals[name] += request.amount
            self.calls[name] += 1
            return {"total": self.totals[name], "calls": self.calls[name]}

# %% 11.4 wrong: uses a dict in the class | hint: A new Sessions object already had a total
replace("    def __init__(self):\n        self.sessions = {}\n", "    sessions = {}\n")
# %% 11.4 wrong: uses one total for all sessions | hint: The total also contains the amounts of other sessions
replace('request._connection_header.get("session")', '"everybody"')
# %% 11.4 wrong: forgets the total after each call | hint: The response contains only the amount of this call
replace("self.sessions.get(session, (0, 0))", "0, 0")
# %% 11.4 wrong: combines the session with the name of the node | hint: The total started again at 0 for another node
replace('connection header")', 'connection header")\n        session += request._connection_header["callerid"]')
# %% 11.4 wrong: counts the calls of all sessions | hint: The field `calls` is wrong
replace("self.sessions = {}", "self.sessions, self.calls = {}, 0")
replace("return AddUpResponse(*self.sessions[session])", """self.calls += 1
        return AddUpResponse(self.sessions[session][0], self.calls)""")
# %% 11.4 wrong: starts a session again if its total is 0 | hint: The number of calls started again at 1, because the total of the session was 0
replace("(session, (0, 0))", "(session, (0, 0))\n        if total == 0:\n            calls = 0")
# %% 11.4 wrong: omits the number of calls | hint: The field `calls` is 0
replace("AddUpResponse(*self.sessions[session])", "AddUpResponse(total=self.sessions[session][0])")
# %% 11.4 wrong: accepts a call without a session | hint: Your server accepted a call without a session
replace('\n        if not session:\n            raise rospy.ServiceException("no field session in the connection header")', "")
# %% 11.4 wrong: raises a KeyError if the field is missing | hint: and this caused an exception of the wrong type
replace('.get("session")', '["session"]')
# %% 11.4 wrong: raises a KeyError for a new session | hint: At the first call of a session, the dict has no total for this
replace("self.sessions.get(session, (0, 0))", "self.sessions[session]")
# %% 11.4 wrong: reads the session from the request | hint: The handler uses an attribute that does not exist
replace('request._connection_header.get("session")', "request.session")
# %% 11.4 wrong: refuses without the reason | hint: The error message does not contain the word "session"
replace('"no field session in the connection header"', '"no"')
# %% 11.4 wrong: raises another exception | hint: The handler raised an exception of the wrong type
replace("""raise rospy.ServiceException("no field session in the connection header")
        """, 'raise ValueError("the field session is missing")\n        ')
# %% 11.4 wrong: returns None instead of refusing | hint: The handler returned None, so
replace('raise rospy.ServiceException("no field session in the connection header")', "return None")
# %% 11.4 wrong: returns the total before the call | hint: The field `total` is 0
replace("field session in the connection header", "session")
replace("*self.sessions[session]", "total, calls + 1")
# %% 11.4 wrong: exchanges the total and the number of calls | hint: The field `total` contains the number of calls
replace("field session in the connection header", "session")
replace("total, calls", "calls, total")
replace("total + request.amount, calls + 1", "calls + 1, total + request.amount")
# %% 11.4 wrong: refuses the second node of a session | hint: Calls from several nodes can belong to one session
replace("self.sessions = {}", "self.sessions, self.owner = {}, {}")
replace('("no field session in the connection header")', """("no session")
        if self.owner.setdefault(session, request._connection_header["callerid"]) != request._connection_header["callerid"]:
            raise rospy.ServiceException("this session is not yours")""")
# %% 11.4 wrong: forgets old sessions | hint: The response contains only the amount of this call
replace("        total, calls", "        for old in list(self.sessions)[:-3]:\n            del self.sessions[old]\n        total, calls")
# %% 11.4 wrong: starts another program that offers the service | hint: Your code starts another program
import subprocess
import sys


class Sessions:
    def handle(self, request):
        return AddUpResponse()


SERVER = """
import rospy
from course_pkg.srv import AddUp
rospy.init_node("adder")
rospy.Service("/my_add_up", AddUp, lambda request: (request.amount, 1))
rospy.spin()
"""
sessions = Sessions()
my_add_up = subprocess.Popen([sys.executable, "-c", SERVER])
rospy.wait_for_service("/my_add_up", timeout=15)
# %% 11.4 wrong: reads a field with another name | hint: The header had the field "session", but your handler refused the call
replace('get("session")', 'get("sessions")')
# %% 11.4 wrong: calls the course's service | hint: Your handler called a different service, and this call failed
replace("        total, calls", """        add_up = rospy.ServiceProxy("/add_up", AddUp, headers={"session": session})
        return AddUpResponse(add_up(request.amount).total, 1)
        total, calls""")
# %% 11.4 wrong: begins the total with 1 | hint: The field `total` is wrong
replace("(0, 0)", "(1, 0)")
# %% 11.4 wrong: forgets to return | hint: The handler returned None. Return an AddUpResponse
replace("return AddUpResponse", "AddUpResponse")
# %% 11.4 wrong: unpacks None for a new session | hint: The handler raised the error that you see above
replace("(session, (0, 0))", "(session)")

# %% 11.5 right: examines the error message
class Keeper:
    def __init__(self, service):
        self.service = service
        self.connect()

    def connect(self):
        self.proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)

    def measure(self, length, width, height):
        try:
            return self.proxy(length, width, height)
        except (rospy.ServiceException, rospy.exceptions.TransportException, AttributeError) as error:
            if "responded with an error" in str(error):
                raise
        self.proxy.close()
        self.connect()
        return self.proxy(length, width, height)

# %% 11.5 right: uses a loop with two iterations
class Keeper:
    def __init__(self, service):
        self.service = service
        self.proxy = None

    def measure(self, length, width, height):
        for attempt in (1, 2):
            if self.proxy is None:
                self.proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)
            try:
                return self.proxy(length, width, height)
            except Exception as error:
                if "responded with an error" in str(error) or attempt == 2:
                    raise
                self.proxy.close()
                self.proxy = None

# %% 11.5 wrong: waits for the server | hint: Your method did not return after the server had ended
replace("        self.proxy.close()\n", "        rospy.wait_for_service(self.service)\n")
# %% 11.5 wrong: sends the sides in another order | hint: The sides in the request are wrong
replace("            return self.proxy(length, width, height)", "            return self.proxy(width, length, height)")
# %% 11.5 wrong: uses a new connection for each call | hint: The connection was not persistent
replace("self.service = service … persistent=True)", "self.proxy = rospy.ServiceProxy(service, geometry)")
replace("\n        try: … .connect()", "")
# %% 11.5 wrong: creates a new persistent proxy for each call | hint: There was more than one connection
class Keeper:
    def __init__(self, service):
        self.service = service

    def measure(self, length, width, height):
        proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)
        try:
            return proxy(length, width, height)
        finally:
            proxy.close()

# %% 11.5 wrong: never connects again | hint: The connection broke, and your method raised the error
based_on("uses a new connection for each call")
replace("geometry", "geometry, persistent=True")
# %% 11.5 wrong: calls the dead proxy again | hint: The connection broke, and your method raised the error
replace("        self.proxy.close()\n        self.connect()\n", "")

# %% 11.5 wrong: treats a refusal as a broken connection | hint: The server refused the call, but the connection works
class Keeper:
    def __init__(self, service):
        self.service = service
        self.connect()

    def connect(self):
        self.proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)

    def measure(self, length, width, height):
        for _ in range(3):
            try:
                return self.proxy(length, width, height)
            except rospy.ServiceException as error:
                last = error
                if "responded" in str(error):
                    continue
                self.connect()
        raise last

# %% 11.5 wrong: returns nothing after a refusal | hint: The server refused the call, but your method did not raise
replace("raise", "return None")
# %% 11.5 wrong: connects again after a refusal | hint: There was more than one connection
replace("""except (rospy.ServiceException, rospy.exceptions.TransportException, AttributeError) as error:
            if "responded with an error" in str(error):""", """except rospy.ServiceException as error:
            self.proxy.close()
            self.connect()
            if "responded" in str(error):""")
replace("\n        self.proxy.close … width, height)", "\n            return self.proxy(length, width, height)")
# %% 11.5 wrong: repeats without a limit | hint: Your method called the service again and again
based_on("treats a refusal as a broken connection")
replace("for _ in range(3):", "while True:")
replace("\n                last = error", "")
replace("continue", "raise\n                self.proxy.close()")
replace("self.connect()\n        raise last", "self.connect()")
# %% 11.5 wrong: forgets to return | hint: Return the response of the proxy
based_on("uses a new connection for each call")
replace("geometry", "geometry, persistent=True")
replace("return self", "self")
# %% 11.5 wrong: calls itself without end | hint: Your method called the service again and again
replace("raise\n        self.proxy.close()", "raise")
replace("()\n        return self.proxy", "()\n        return self.measure")
# %% 11.5 wrong: catches only ServiceException | hint: A broken connection can raise three kinds of errors
replace("(rospy.ServiceException, rospy.exceptions.TransportException, AttributeError)", "rospy.ServiceException")
# %% 11.5 wrong: does not catch AttributeError | hint: A broken connection can raise three kinds of errors
replace(", AttributeError)", ")")
# %% 11.5 wrong: does not catch AttributeError, and stores the proxy in a list | hint: A broken connection can raise three kinds of errors
based_on("does not catch AttributeError")
replace("self.proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)", "self.proxies = [rospy.ServiceProxy(self.service, geometry, persistent=True)]")
replace("self.proxy.close", "self.proxies[0].close")
replace("self.proxy(", "self.proxies[0](", times=2)
# %% 11.5 wrong: does not catch AttributeError, and hides the proxy | hint: A broken connection can raise three kinds of errors
based_on("does not catch AttributeError")
replace("    def connect(self):", "    def connect(self):\n        __import__('gc').freeze()")
replace("persistent=True)", "persistent=True)\n        __import__('gc').freeze()")
# %% 11.5 wrong: stores the proxy in the class | hint: A second object of the class changed the proxy
replace("        self.proxy = rospy", "        Keeper.proxy = rospy")
# %% 11.5 wrong: returns the volume | hint: Return the whole response of the proxy
based_on("uses a loop with two iterations")
replace("height)\n            except", "height).volume\n            except")
# %% 11.5 wrong: does not store the new proxy | hint: After the connection broke, your
replace("\n        self.connect()\n\n    def connect(self):", "")
replace("\n        self.proxy.close()\n        self.connect()\n        return self.proxy(length, width, height)", """
        proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)
        return proxy(length, width, height)""")
# %% 11.5 wrong: returns the last response if the connection is broken | hint: The server sent a different response to this call
based_on("examines the error message")
replace("            return self.proxy(length, width, height)\n", "            self.last = self.proxy(length, width, height)\n            return self.last\n")
replace("        self.connect()\n        return self.proxy(length, width, height)", "        self.connect()\n        return self.last")
# %% 11.5 wrong: returns None after the second failure | hint: The second call also failed, so there is no response
based_on("uses a loop with two iterations")
replace(" or attempt == 2", "")
# %% 11.5 wrong: raises the first error again | hint: The server refused the second call, but your method raised a different error
replace("raise\n", "raise\n            first = error\n")
replace("\n        return self.proxy(length, width, height)", """
        try:
            return self.proxy(length, width, height)
        except rospy.ServiceException:
            raise first""")

# %% 11.6 right: looks up the address in the constructor
class Remembering:
    def __init__(self, service):
        self.service = service
        self.look_up()

    def look_up(self):
        self.uri = rosgraph.Master(node.name).lookupService(self.service)

    def measure(self, length, width, height):
        try:
            return ask(self.uri, self.service, length, width, height)
        except OSError:
            self.look_up()
            return ask(self.uri, self.service, length, width, height)

# %% 11.6 right: looks up the address in the first call
class Remembering:
    def __init__(self, service):
        self.service = service
        self.uri = None

    def measure(self, length, width, height):
        if self.uri is not None:
            try:
                return ask(self.uri, self.service, length, width, height)
            except OSError:
                pass
        self.uri = rosgraph.Master("/me").lookupService(self.service)
        return ask(self.uri, self.service, length, width, height)

# %% 11.6 wrong: looks up the address for each call | hint: Your method looked up the address again, but the master no longer knows the
class Remembering:
    def __init__(self, service):
        self.service = service

    def measure(self, length, width, height):
        uri = rosgraph.Master(node.name).lookupService(self.service)
        return ask(uri, self.service, length, width, height)

# %% 11.6 wrong: sends the sides in another order | hint: The sides in the request are wrong
replace("self.service, length, width, height", "self.service, height, length, width", times=2)
# %% 11.6 wrong: never looks up the address again | hint: No server responds at the old address any more
based_on("looks up the address for each call")
replace("\n\n", "\n        self.uri = rosgraph.Master(node.name).lookupService(service)\n\n")
replace("uri = rosgraph.Master(node.name).lookupService(self.service)\n        return ask(uri", "return ask(self.uri")
# %% 11.6 wrong: treats a refusal as a missing server | hint: The server refused the call, so the address was right
replace("OSError", "Exception")
# %% 11.6 wrong: calls twice after a refusal | hint: Your method called `ask()` twice
class Remembering:
    def __init__(self, service):
        self.service = service
        self.uri = rosgraph.Master(node.name).lookupService(service)

    def measure(self, length, width, height):
        for _ in range(2):
            try:
                return ask(self.uri, self.service, length, width, height)
            except rospy.ServiceException as error:
                last = error
        raise last

# %% 11.6 wrong: catches only a refused connection | hint: Another program uses this address now, so `ask()` raised a different kind of OSError
replace("OSError", "ConnectionRefusedError")
# %% 11.6 wrong: catches only a ConnectionError | hint: and `ask()` raised an OSError that is not a ConnectionError
replace("OSError", "ConnectionError")
# %% 11.6 wrong: tries the old address three times | hint: Your method called `ask()` several times with the old address
replace("        try:\n            return ask(self.uri, self.service, length, width, height)\n        except OSError:\n            self", """        for _ in range(3):
            try:
                return ask(self.uri, self.service, length, width, height)
            except OSError:
                rospy.sleep(0.2)
        if True:
            self""")
# %% 11.6 wrong: looks up the address without end | hint: Your method called the service again and again
replace("try:\n            return ask(self.uri, self.service, length, width, height)\n        except OSError:\n            self.look_up()\n            return ask(self.uri, self.service, length, width, height)", """while True:
            try:
                return ask(self.uri, self.service, length, width, height)
            except OSError:
                self.look_up()""")
# %% 11.6 wrong: makes up to five attempts | hint: Your method called the service again and again
based_on("looks up the address without end")
replace("while True:", "for attempt in range(5):")
replace("                self.look_up()", "                self.look_up()\n        raise ConnectionError")
# %% 11.6 wrong: returns None after the second error | hint: The second call also failed. Raise
replace("self.look_up()\n            return ask(self.uri, self.service, length, width, height)", """self.look_up()
        try:
            return ask(self.uri, self.service, length, width, height)
        except OSError:
            return None""")
# %% 11.6 wrong: uses one address for all objects | hint: A second object of the class changed the server address
replace("self.uri = ", "Remembering.uri = ")
# %% 11.6 wrong: does not store the new address | hint: Store every address that you look up
replace("\n            self.look_up()\n            return ask(self.uri, self.service, length, width, height)", """
            uri = rosgraph.Master(node.name).lookupService(self.service)
            return ask(uri, self.service, length, width, height)""")
# %% 11.6 wrong: forgets to return | hint: Return the tuple that `ask()` returns
based_on("never looks up the address again")
replace("return ", "")
# %% 11.6 wrong: calls the master first | hint: Your method looked up the address again, although the stored address was
based_on("looks up the address in the first call")
replace("\n    def measure … self.service)", """    def measure(self, length, width, height):
        try:
            self.uri = rosgraph.Master(node.name).lookupService(self.service)
        except rosgraph.MasterError:
            pass""")
# %% 11.6 wrong: calls the master, and ignores its response | hint: Your method looked up the address again, although the stored address was
replace("        try:", "        try:\n            rosgraph.Master(node.name).lookupService(self.service)\n        except rosgraph.MasterError:\n            pass\n        try:")
# %% 11.6 wrong: returns only one of the two numbers | hint: Your method did not return the numbers that `ask()` returned
replace("height)\n        except", "height)[1]\n        except")
