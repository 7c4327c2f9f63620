"""The cells that run before and after an answer of chapter 11 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
import socket
import struct

import rosgraph
import rospy
from course_pkg import join
from course_pkg.srv import AddUp, AddUpResponse, geometry

node = join("chapter_11")

# %% 11.3 before
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

# %% 11.4 after
if "sessions" not in globals():
    sessions = Sessions()
    my_add_up = rospy.Service("/my_add_up", AddUp, sessions.handle)

# %% 11.6 before
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
