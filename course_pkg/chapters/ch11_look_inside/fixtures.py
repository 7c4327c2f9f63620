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


def read_header(data):
    fields = {}
    while data:
        (length,) = struct.unpack("<I", data[:4])
        name, _, value = data[4 : 4 + length].decode().partition("=")
        fields[name] = value
        data = data[4 + length :]
    return fields

# %% 11.3 11.6 before
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

# %% 11.4 after
if "sessions" not in globals():
    sessions = Sessions()
    my_add_up = rospy.Service("/my_add_up", AddUp, sessions.handle)

# %% 11.6 before
def ask(uri, service, length, width, height):
    host, port = uri.removeprefix("rosrpc://").split(":")
    fields = {"callerid": node.name, "service": service, "md5sum": geometry._md5sum}
    request = struct.pack("<3f", length, width, height)
    with socket.create_connection((host, int(port)), timeout=5) as sock:
        sock.sendall(pack_header(fields))
        receive(sock, int.from_bytes(receive(sock, 4), "little"))
        sock.sendall(struct.pack("<I", len(request)) + request)
        worked = receive(sock, 1) == b"\x01"
        answer = receive(sock, int.from_bytes(receive(sock, 4), "little"))
    if not worked:
        raise rospy.ServiceException(answer.decode())
    return struct.unpack("<2f", answer)
