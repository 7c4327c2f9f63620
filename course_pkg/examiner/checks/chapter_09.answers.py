"""What students answer in chapter 09; see answers.py for the form of this file."""

# %% before
import socket
import struct

import rosgraph
import rospy
from course_pkg import join
from course_pkg.srv import AddUp, AddUpResponse, geometry

node = join("chapter_09")

# %% 09.1 right: field by field
def pack_header(fields):
    body = b""
    for name, value in fields.items():
        text = f"{name}={value}".encode()
        body += struct.pack("<I", len(text)) + text
    return struct.pack("<I", len(body)) + body

# %% 09.1 right: without struct
def pack_header(fields):
    def sized(data):
        return len(data).to_bytes(4, "little") + data

    return sized(b"".join(sized((name + "=" + value).encode("utf-8")) for name, value in fields.items()))

# %% 09.1 right: library, sorted
import rosgraph.network
def pack_header(fields):
    return rosgraph.network.encode_ros_handshake_header(fields)

# %% 09.1 right: sorted by name, into a buffer
import io
def pack_header(fields):
    buffer = io.BytesIO()
    for name in sorted(fields):
        line = bytes(f"{name}={fields[name]}", "utf8")
        buffer.write(struct.pack("<L", len(line)))
        buffer.write(line)
    body = buffer.getvalue()
    return struct.pack("<I%ds" % len(body), len(body), body)

# %% 09.1 wrong: big-endian | hint: Least byte first
def pack_header(fields):
    body = b""
    for name, value in fields.items():
        text = f"{name}={value}".encode()
        body += struct.pack("!I", len(text)) + text
    return struct.pack("!I", len(body)) + body

# %% 09.1 wrong: no length of the whole | hint: The length of the whole header is missing
def pack_header(fields):
    body = b""
    for name, value in fields.items():
        text = f"{name}={value}".encode()
        body += struct.pack("<I", len(text)) + text
    return body

# %% 09.1 wrong: counts its own length | hint: The first length counts itself
def pack_header(fields):
    body = b""
    for name, value in fields.items():
        text = f"{name}={value}".encode()
        body += struct.pack("<I", len(text)) + text
    return struct.pack("<I", len(body) + 4) + body

# %% 09.1 wrong: counts the fields | hint: The first number is how many fields there are
def pack_header(fields):
    body = struct.pack("<I", len(fields))
    for name, value in fields.items():
        text = f"{name}={value}".encode()
        body += struct.pack("<I", len(text)) + text
    return body

# %% 09.1 wrong: counts letters | hint: A length counts bytes
def pack_header(fields):
    body = b""
    for name, value in fields.items():
        text = f"{name}={value}"
        body += struct.pack("<I", len(text)) + text.encode()
    return struct.pack("<I", len(body)) + body

# %% 09.1 wrong: as HTTP has it | hint: Between name and value stands an equals sign
def pack_header(fields):
    body = b""
    for name, value in fields.items():
        text = f"{name}: {value}".encode()
        body += struct.pack("<I", len(text)) + text
    return struct.pack("<I", len(body)) + body

# %% 09.1 wrong: one length for all | hint: Each field needs its own length
def pack_header(fields):
    body = "".join(f"{name}={value}" for name, value in fields.items()).encode()
    return struct.pack("<I", len(body)) + body

# %% 09.1 wrong: forgets to return | hint: without a return line
def pack_header(fields):
    body = b"".join(struct.pack("<I", len(name)) + name.encode() for name in fields)
    struct.pack("<I", len(body)) + body

# %% 09.1 wrong: text | hint: encode() makes them
def pack_header(fields):
    return "\n".join(f"{name}={value}" for name, value in fields.items())

# %% 09.1 wrong: ascii | hint: which knows every letter
def pack_header(fields):
    body = b""
    for name, value in fields.items():
        text = f"{name}={value}".encode("ascii")
        body += struct.pack("<I", len(text)) + text
    return struct.pack("<I", len(body)) + body

# %% 09.1 wrong: latin-1 | hint: in which ü is two bytes
def pack_header(fields):
    body = b""
    for name, value in fields.items():
        text = f"{name}={value}".encode("latin-1")
        body += struct.pack("<I", len(text)) + text
    return struct.pack("<I", len(body)) + body

# %% 09.1 wrong: list of ints | hint: bytes(...) makes them
def pack_header(fields):
    body = []
    for name, value in fields.items():
        text = list(f"{name}={value}".encode())
        body += list(struct.pack("<I", len(text))) + text
    return list(struct.pack("<I", len(body))) + body

# %% 09.1 wrong: two-byte lengths | hint: a number of 4 bytes
def pack_header(fields):
    body = b""
    for name, value in fields.items():
        text = f"{name}={value}".encode()
        body += struct.pack("<H", len(text)) + text
    return struct.pack("<H", len(body)) + body

# %% 09.1 wrong: nothing for no field | hint: No field makes a header
def pack_header(fields):
    if not fields:
        return b""
    body = b""
    for name, value in fields.items():
        text = f"{name}={value}".encode()
        body += struct.pack("<I", len(text)) + text
    return struct.pack("<I", len(body)) + body

# %% 09.2 right: adds up
def receive(sock, count):
    data = b""
    while len(data) < count:
        piece = sock.recv(count - len(data))
        if not piece:
            raise ConnectionError("the other end has closed")
        data += piece
    return data

# %% 09.2 right: a list of pieces
def receive(sock, count):
    pieces = []
    missing = count
    while missing > 0:
        pieces.append(sock.recv(missing))
        if pieces[-1] == b"":
            raise ConnectionResetError(f"{missing} bytes are missing")
        missing -= len(pieces[-1])
    return b"".join(pieces)

# %% 09.2 right: the socket's own way to wait for all
def receive(sock, count):
    data = sock.recv(count, socket.MSG_WAITALL) if count else b""
    if len(data) < count:
        raise ConnectionError("the other end has closed")
    return data

# %% 09.2 right: peeks until all are there
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

# %% 09.2 wrong: once | hint: recv returned what was there
def receive(sock, count):
    return sock.recv(count)

# %% 09.2 wrong: never notices the end | hint: recv gives b'' for ever
def receive(sock, count):
    data = b""
    while len(data) < count:
        data += sock.recv(count - len(data))
    return data

# %% 09.2 wrong: reads ahead | hint: These are more than were due
def receive(sock, count):
    data = b""
    while len(data) < count:
        piece = sock.recv(4096)
        if not piece:
            raise ConnectionError("the other end has closed")
        data += piece
    return data

# %% 09.2 wrong: throws away what it read ahead | hint: It waits for more than was due
def receive(sock, count):
    data = b""
    while len(data) < count:
        piece = sock.recv(4096)
        if not piece:
            raise ConnectionError("the other end has closed")
        data += piece
    return data[:count]

# %% 09.2 wrong: gives back what there was | hint: It returned fewer bytes than were due
def receive(sock, count):
    data = b""
    while len(data) < count:
        piece = sock.recv(count - len(data))
        if not piece:
            break
        data += piece
    return data

# %% 09.2 wrong: only the last piece | hint: recv returned what was there
def receive(sock, count):
    while count > 0:
        data = sock.recv(count)
        if not data:
            raise ConnectionError("the other end has closed")
        count -= len(data)
    return data

# %% 09.2 wrong: forgets to return | hint: without a return line
def receive(sock, count):
    data = b""
    while len(data) < count:
        data += sock.recv(count - len(data))

# %% 09.2 wrong: a short piece is taken for the end | hint: Go on until all have come
def receive(sock, count):
    data = sock.recv(count)
    if len(data) < count:
        raise ConnectionError("too short")
    return data

# %% 09.2 wrong: buffered file | hint: unless buffering=0
def receive(sock, count):
    data = sock.makefile("rb").read(count)
    if len(data) < count:
        raise ConnectionError("too short")
    return data

# %% 09.2 wrong: sleeps | hint: Go on until all have come
import time
def receive(sock, count):
    time.sleep(0.2)
    data = sock.recv(count)
    if len(data) < count:
        raise ConnectionError("too short")
    return data

# %% 09.2 wrong: none due is taken for an end | hint: None were due
def receive(sock, count):
    data = b""
    while True:
        piece = sock.recv(count - len(data))
        if not piece:
            raise ConnectionError("closed")
        data += piece
        if len(data) == count:
            return data

# %% 09.2 wrong: a list of pieces | hint: Those are the pieces
def receive(sock, count):
    pieces = []
    while count > 0:
        piece = sock.recv(count)
        if not piece:
            raise ConnectionError("closed")
        pieces.append(piece)
        count -= len(piece)
    return pieces

# %% 09.2 wrong: closes the socket | hint: The socket is closed
def receive(sock, count):
    with sock:
        data = b""
        while len(data) < count:
            piece = sock.recv(count - len(data))
            if not piece:
                raise ConnectionError("closed")
            data += piece
        return data

# %% 09.3 before
def pack_header(fields):
    def sized(data):
        return struct.pack("<I", len(data)) + data

    return sized(b"".join(sized(f"{name}={value}".encode()) for name, value in fields.items()))


def receive(sock, count):
    data = b""
    while len(data) < count:
        piece = sock.recv(count - len(data))
        if not piece:
            raise ConnectionError("the other end has closed")
        data += piece
    return data


def read_header(data):
    fields = {}
    while data:
        (length,) = struct.unpack("<I", data[:4])
        name, _, value = data[4 : 4 + length].decode().partition("=")
        fields[name] = value
        data = data[4 + length :]
    return fields

# %% 09.3 right: step by step
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

# %% 09.3 right: with a file in place of the socket
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

# %% 09.3 right: says in a comment what it is for
from rospy.core import parse_rosrpc_uri
def ask(uri, service, length, width, height):
    """Call as rospy.ServiceProxy does, with a socket alone; see also rosservice."""
    # no node.call here
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

# %% 09.3 wrong: lets a proxy do it | hint: Let no proxy do it for you
def ask(uri, service, length, width, height):
    response = rospy.ServiceProxy(service, geometry)(length, width, height)
    return response.area, response.volume

# %% 09.3 wrong: no length in front of the request | hint: A request begins with its length
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        receive(sock, size)
        sock.sendall(struct.pack("<3f", length, width, height))
        receive(sock, 5)
        return struct.unpack("<2f", receive(sock, 8))

# %% 09.3 wrong: big-endian | hint: The length of the request is big-endian
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        receive(sock, size)
        sock.sendall(struct.pack(">I3f", 12, length, width, height))
        receive(sock, 5)
        return struct.unpack(">2f", receive(sock, 8))

# %% 09.3 wrong: doubles | hint: 24 bytes are three float64
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        receive(sock, size)
        sock.sendall(struct.pack("<I3d", 24, length, width, height))
        receive(sock, 5)
        return struct.unpack("<2d", receive(sock, 16))

# %% 09.3 wrong: forgets the ok byte | hint: The reply is an ok byte, 4 bytes of length
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=2) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        receive(sock, size)
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        (size,) = struct.unpack("<I", receive(sock, 4))
        return struct.unpack("<2f", receive(sock, size))

# %% 09.3 wrong: one recv for the reply | hint: The bytes came one at a time
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        receive(sock, size)
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        reply = sock.recv(4096)
        if reply[0] == 0:
            raise rospy.ServiceException(reply[5:].decode())
        return struct.unpack("<2f", reply[5:])

# %% 09.3 wrong: a star for the MD5 | hint: A star matches everything
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": "*"}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        receive(sock, size)
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        receive(sock, 5)
        return struct.unpack("<2f", receive(sock, 8))

# %% 09.3 wrong: does not say which service | hint: One port serves all services of a node
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        receive(sock, size)
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        receive(sock, 5)
        return struct.unpack("<2f", receive(sock, 8))

# %% 09.3 wrong: takes every header for a yes | hint: Look for it before you send the request
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        receive(sock, size)
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        worked = receive(sock, 1) == b"\x01"
        (size,) = struct.unpack("<I", receive(sock, 4))
        answer = receive(sock, size)
    if not worked:
        raise rospy.ServiceException(answer.decode())
    return struct.unpack("<2f", answer)

# %% 09.3 wrong: takes every reply for a yes | hint: The ok byte was 0
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        theirs = read_header(receive(sock, size))
        if "error" in theirs:
            raise rospy.ServiceException(theirs["error"])
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        receive(sock, 5)
        return struct.unpack("<2f", receive(sock, 8))

# %% 09.3 wrong: says no in words of its own | hint: Put the server's own words into the error
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        if "error" in read_header(receive(sock, size)):
            raise rospy.ServiceException("it does not want to")
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        if receive(sock, 1) == b"\x00":
            raise rospy.ServiceException("it failed")
        receive(sock, 4)
        return struct.unpack("<2f", receive(sock, 8))

# %% 09.3 wrong: volume first | hint: That is the volume first
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        receive(sock, size)
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        receive(sock, 5)
        volume, area = struct.unpack("<2f", receive(sock, 8))
        return area, volume

# %% 09.3 wrong: waits for the server to speak | hint: The client speaks first
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=2) as sock:
        (size,) = struct.unpack("<I", receive(sock, 4))
        receive(sock, size)
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        receive(sock, 5)
        return struct.unpack("<2f", receive(sock, 8))

# %% 09.3 wrong: RuntimeError for no | hint: The error has to be a rospy.ServiceException
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        theirs = read_header(receive(sock, size))
        if "error" in theirs:
            raise RuntimeError(theirs["error"])
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        worked, size = struct.unpack("<?I", receive(sock, 5))
        answer = receive(sock, size)
    if not worked:
        raise RuntimeError(answer.decode())
    return struct.unpack("<2f", answer)

# %% 09.3 wrong: returns a response | hint: Return the two numbers
from course_pkg.srv import geometryResponse
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        theirs = read_header(receive(sock, size))
        if "error" in theirs:
            raise rospy.ServiceException(theirs["error"])
        sock.sendall(struct.pack("<I3f", 12, length, width, height))
        worked, size = struct.unpack("<?I", receive(sock, 5))
        answer = receive(sock, size)
    if not worked:
        raise rospy.ServiceException(answer.decode())
    return geometryResponse(*struct.unpack("<2f", answer))

# %% 09.3 wrong: sends no request and goes | hint: The header arrived, and no request
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum}))
        (size,) = struct.unpack("<I", receive(sock, 4))
        theirs = read_header(receive(sock, size))
    return length * width, length * width * height

# %% 09.3 wrong: forgets the length of the header | hint: The header has to begin with its own length
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    with socket.create_connection((host, int(port)), timeout=3) as sock:
        sock.sendall(pack_header({"callerid": node.name, "service": service, "md5sum": geometry._md5sum})[4:])
        (size,) = struct.unpack("<I", receive(sock, 4))
        receive(sock, size)

# %% 09.4 right: a dict of pairs
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

# %% 09.4 right: two counters and a lock
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

# %% 09.4 after
node.serve("/my_add_up", AddUp, Sessions().handle)

# %% 09.4 wrong: one total for everybody | hint: That is everybody's amounts in one total
class Sessions:
    def __init__(self):
        self.total = 0
        self.calls = 0

    def handle(self, request):
        self.total += request.amount
        self.calls += 1
        return AddUpResponse(self.total, self.calls)

# %% 09.4 wrong: keeps nothing | hint: That is this amount alone
class Sessions:
    def __init__(self):
        self.totals = {}

    def handle(self, request):
        totals = {}
        session = request._connection_header["session"]
        totals[session] = totals.get(session, 0) + request.amount
        return AddUpResponse(totals[session], 1)

# %% 09.4 wrong: goes by the node as well | hint: It began anew
class Sessions:
    def __init__(self):
        self.totals = {}

    def handle(self, request):
        header = request._connection_header
        who = header["callerid"], header.get("session")
        total, calls = self.totals.get(who, (0, 0))
        self.totals[who] = total + request.amount, calls + 1
        return AddUpResponse(*self.totals[who])

# %% 09.4 wrong: counts the calls of all | hint: Count for each session apart
class Sessions:
    def __init__(self):
        self.totals = {}
        self.calls = 0

    def handle(self, request):
        session = request._connection_header["session"]
        self.calls += 1
        self.totals[session] = self.totals.get(session, 0) + request.amount
        return AddUpResponse(self.totals[session], self.calls)

# %% 09.4 wrong: leaves the calls out | hint: calls is 0
class Sessions:
    def __init__(self):
        self.totals = {}

    def handle(self, request):
        session = request._connection_header["session"]
        self.totals[session] = self.totals.get(session, 0) + request.amount
        return AddUpResponse(total=self.totals[session])

# %% 09.4 wrong: a session for those who have none | hint: Nobody knows whose total that is
class Sessions:
    def __init__(self):
        self.totals = {}

    def handle(self, request):
        session = request._connection_header.get("session", "")
        total, calls = self.totals.get(session, (0, 0))
        self.totals[session] = total + request.amount, calls + 1
        return AddUpResponse(*self.totals[session])

# %% 09.4 wrong: stumbles over a missing field | hint: Look for it with .get
class Sessions:
    def __init__(self):
        self.totals = {}

    def handle(self, request):
        session = request._connection_header["session"]
        total, calls = self.totals.get(session, (0, 0))
        self.totals[session] = total + request.amount, calls + 1
        return AddUpResponse(*self.totals[session])

# %% 09.4 wrong: stumbles over a new session | hint: begin with 0
class Sessions:
    def __init__(self):
        self.totals = {}
        self.calls = {}

    def handle(self, request):
        session = request._connection_header["session"]
        self.totals[session] += request.amount
        self.calls[session] += 1
        return AddUpResponse(self.totals[session], self.calls[session])

# %% 09.4 wrong: looks for it in the request | hint: The fields of the header are in request._connection_header
class Sessions:
    def __init__(self):
        self.totals = {}

    def handle(self, request):
        total, calls = self.totals.get(request.session, (0, 0))
        self.totals[request.session] = total + request.amount, calls + 1
        return AddUpResponse(*self.totals[request.session])

# %% 09.4 wrong: refuses without a reason | hint: Name the field in the refusal
class Sessions:
    def __init__(self):
        self.totals = {}

    def handle(self, request):
        session = request._connection_header.get("session")
        if not session:
            raise rospy.ServiceException("no")
        total, calls = self.totals.get(session, (0, 0))
        self.totals[session] = total + request.amount, calls + 1
        return AddUpResponse(*self.totals[session])

# %% 09.4 wrong: another exception | hint: Another exception came out
class Sessions:
    def __init__(self):
        self.sessions = {}
    def handle(self, request):
        session = request._connection_header.get("session")
        if not session:
            raise ValueError("the field session is missing")
        total, calls = self.sessions.get(session, (0, 0))
        self.sessions[session] = total + request.amount, calls + 1
        return AddUpResponse(*self.sessions[session])

# %% 09.4 wrong: None for a refusal | hint: The handler returned nothing
class Sessions:
    def __init__(self):
        self.sessions = {}
    def handle(self, request):
        session = request._connection_header.get("session")
        if not session:
            return None
        total, calls = self.sessions.get(session, (0, 0))
        self.sessions[session] = total + request.amount, calls + 1
        return AddUpResponse(*self.sessions[session])

# %% 09.4 wrong: the total before this one | hint: this amount was not added
class Sessions:
    def __init__(self):
        self.sessions = {}
    def handle(self, request):
        session = request._connection_header.get("session")
        if not session:
            raise rospy.ServiceException("no session")
        total, calls = self.sessions.get(session, (0, 0))
        self.sessions[session] = total + request.amount, calls + 1
        return AddUpResponse(total, calls + 1)

# %% 09.4 wrong: total and calls exchanged | hint: the total comes first
class Sessions:
    def __init__(self):
        self.sessions = {}
    def handle(self, request):
        session = request._connection_header.get("session")
        if not session:
            raise rospy.ServiceException("no session")
        calls, total = self.sessions.get(session, (0, 0))
        self.sessions[session] = calls + 1, total + request.amount
        return AddUpResponse(*self.sessions[session])

# %% 09.4 wrong: refuses the second node | hint: Another node may go on
class Sessions:
    def __init__(self):
        self.sessions, self.owner = {}, {}
    def handle(self, request):
        session = request._connection_header.get("session")
        if not session:
            raise rospy.ServiceException("no session")
        if self.owner.setdefault(session, request._connection_header["callerid"]) != request._connection_header["callerid"]:
            raise rospy.ServiceException("this session is not yours")
        total, calls = self.sessions.get(session, (0, 0))
        self.sessions[session] = total + request.amount, calls + 1
        return AddUpResponse(*self.sessions[session])

# %% 09.5 right: by the words of the error
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

# %% 09.5 right: a loop of two
class Keeper:
    def __init__(self, service):
        self.service = service
        self.proxy = None

    def measure(self, length, width, height):
        for attempt in (1, 2):
            if self.proxy is None:
                self.proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)
            try:
                return self.proxy(length, width, height).volume
            except Exception as error:
                if "responded with an error" in str(error) or attempt == 2:
                    raise
                self.proxy.close()
                self.proxy = None

# %% 09.5 wrong: a new connection for each call | hint: Make the proxy with persistent=True
class Keeper:
    def __init__(self, service):
        self.proxy = rospy.ServiceProxy(service, geometry)

    def measure(self, length, width, height):
        return self.proxy(length, width, height)

# %% 09.5 wrong: a new persistent proxy for each call | hint: A new connection for each call
class Keeper:
    def __init__(self, service):
        self.service = service

    def measure(self, length, width, height):
        proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)
        try:
            return proxy(length, width, height)
        finally:
            proxy.close()

# %% 09.5 wrong: never connects anew | hint: The connection broke, and the error came out
class Keeper:
    def __init__(self, service):
        self.proxy = rospy.ServiceProxy(service, geometry, persistent=True)

    def measure(self, length, width, height):
        return self.proxy(length, width, height)

# %% 09.5 wrong: asks the dead proxy again | hint: the old one stays broken
class Keeper:
    def __init__(self, service):
        self.proxy = rospy.ServiceProxy(service, geometry, persistent=True)

    def measure(self, length, width, height):
        try:
            return self.proxy(length, width, height)
        except rospy.ServiceException as error:
            if "responded with an error" in str(error):
                raise
            return self.proxy(length, width, height)

# %% 09.5 wrong: takes a refusal for a broken connection | hint: Ask again only if the connection broke
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

# %% 09.5 wrong: swallows a refusal | hint: whoever called has to hear it
class Keeper:
    def __init__(self, service):
        self.service = service
        self.proxy = rospy.ServiceProxy(service, geometry, persistent=True)

    def measure(self, length, width, height):
        try:
            return self.proxy(length, width, height)
        except rospy.ServiceException:
            return None

# %% 09.5 wrong: connects anew after a refusal | hint: A new connection for each call
class Keeper:
    def __init__(self, service):
        self.service = service
        self.connect()

    def connect(self):
        self.proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)

    def measure(self, length, width, height):
        try:
            return self.proxy(length, width, height)
        except rospy.ServiceException as error:
            self.proxy.close()
            self.connect()
            if "responded" in str(error):
                raise
            return self.proxy(length, width, height)

# %% 09.5 wrong: until it works | hint: not until it works
class Keeper:
    def __init__(self, service):
        self.service = service
        self.connect()

    def connect(self):
        self.proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)

    def measure(self, length, width, height):
        while True:
            try:
                return self.proxy(length, width, height)
            except rospy.ServiceException as error:
                if "responded" in str(error):
                    raise
                self.proxy.close()
                self.connect()

# %% 09.5 wrong: forgets to return | hint: return what the proxy returned
class Keeper:
    def __init__(self, service):
        self.proxy = rospy.ServiceProxy(service, geometry, persistent=True)

    def measure(self, length, width, height):
        self.proxy(length, width, height)

# %% 09.5 wrong: three times | hint: It asked again and again
class Keeper:
    def __init__(self, service):
        self.service = service
        self.connect()
    def connect(self):
        self.proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)
    def measure(self, length, width, height):
        for attempt in range(3):
            try:
                return self.proxy(length, width, height)
            except (rospy.ServiceException, rospy.exceptions.TransportException, AttributeError) as error:
                if "responded with an error" in str(error):
                    raise
                last = error
                self.proxy.close()
                self.connect()
        raise last

# %% 09.5 wrong: recursion without end | hint: It asked again and again
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
        self.connect()
        return self.measure(length, width, height)

# %% 09.5 wrong: the new proxy is not kept | hint: was not kept in self
class Keeper:
    def __init__(self, service):
        self.service = service
        self.proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)
    def measure(self, length, width, height):
        try:
            return self.proxy(length, width, height)
        except (rospy.ServiceException, rospy.exceptions.TransportException, AttributeError) as error:
            if "responded with an error" in str(error):
                raise
        proxy = rospy.ServiceProxy(self.service, geometry, persistent=True)
        return proxy(length, width, height)

# %% 09.6 before
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")

    def sized(data):
        return struct.pack("<I", len(data)) + data

    fields = {"callerid": node.name, "service": service, "md5sum": geometry._md5sum}
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        stream = sock.makefile("rb")
        sock.sendall(sized(b"".join(sized(f"{name}={value}".encode()) for name, value in fields.items())))
        stream.read(int.from_bytes(stream.read(4), "little"))
        sock.sendall(sized(struct.pack("<3f", length, width, height)))
        worked = stream.read(1) == b"\x01"
        answer = stream.read(int.from_bytes(stream.read(4), "little"))
    if not worked:
        raise rospy.ServiceException(answer.decode())
    return struct.unpack("<2f", answer)

# %% 09.6 right: in the constructor
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

# %% 09.6 right: when it is needed
class Remembering:
    def __init__(self, service):
        self.service = service
        self.uri = None

    def measure(self, length, width, height):
        if self.uri is not None:
            try:
                return ask(self.uri, self.service, length, width, height)
            except (ConnectionError, TimeoutError):
                pass
        self.uri = rosgraph.Master("/me").lookupService(self.service)
        return ask(self.uri, self.service, length, width, height)

# %% 09.6 wrong: looks up for each call | hint: It had the address from the call before
class Remembering:
    def __init__(self, service):
        self.service = service

    def measure(self, length, width, height):
        uri = rosgraph.Master(node.name).lookupService(self.service)
        return ask(uri, self.service, length, width, height)

# %% 09.6 wrong: never looks again | hint: Nobody is at the old address any more
class Remembering:
    def __init__(self, service):
        self.service = service
        self.uri = rosgraph.Master(node.name).lookupService(service)

    def measure(self, length, width, height):
        return ask(self.uri, self.service, length, width, height)

# %% 09.6 wrong: takes a refusal for an absence | hint: Look up again only if nobody is there
class Remembering:
    def __init__(self, service):
        self.service = service
        self.uri = rosgraph.Master(node.name).lookupService(service)

    def measure(self, length, width, height):
        try:
            return ask(self.uri, self.service, length, width, height)
        except Exception:
            self.uri = rosgraph.Master(node.name).lookupService(self.service)
            return ask(self.uri, self.service, length, width, height)

# %% 09.6 wrong: asks twice after a refusal | hint: Only an OSError means
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

# %% 09.6 wrong: does not keep the new address | hint: Keep what the second look-up said
class Remembering:
    def __init__(self, service):
        self.service = service
        self.uri = rosgraph.Master(node.name).lookupService(service)

    def measure(self, length, width, height):
        try:
            return ask(self.uri, self.service, length, width, height)
        except OSError:
            uri = rosgraph.Master(node.name).lookupService(self.service)
            return ask(uri, self.service, length, width, height)

# %% 09.6 wrong: forgets to return | hint: return what ask returned
class Remembering:
    def __init__(self, service):
        self.service = service
        self.uri = rosgraph.Master(node.name).lookupService(service)

    def measure(self, length, width, height):
        ask(self.uri, self.service, length, width, height)

# %% 09.6 wrong: the master first, the memory if it fails | hint: the address that it had was good
class Remembering:
    def __init__(self, service):
        self.service = service
        self.uri = None
    def measure(self, length, width, height):
        try:
            self.uri = rosgraph.Master(node.name).lookupService(self.service)
        except rosgraph.MasterError:
            pass
        return ask(self.uri, self.service, length, width, height)

# %% 09.6 wrong: a proxy | hint: It looked up again, and the master does not know
class Remembering:
    def __init__(self, service):
        self.proxy = rospy.ServiceProxy(service, geometry)
    def measure(self, length, width, height):
        response = self.proxy(length, width, height)
        return response.area, response.volume
