"""Tests of join(), which registers a kernel as a node."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from course_pkg.ros import MasterClient, PrivateMaster, look
from tests.kernel import Kernel
from tests.support import eventually, stopped

JOIN = "from course_pkg.ros import join\nnode = join('student')"


def test_joining_again_is_the_same_node(kernel: Kernel) -> None:
    """A second call of join() returns the same node."""
    kernel.run(JOIN)
    assert kernel.run("result = join('student') is node, node.name, repr(node)") == [
        True,
        "/student",
        "<node /student>",
    ]


def test_private_master_without_ros_master_uri() -> None:
    """Without ROS_MASTER_URI, a kernel starts its own master."""
    with Kernel({"ROS_MASTER_URI": None}) as kernel:
        kernel.run(JOIN)
        names = "import subprocess; result = subprocess.check_output(['rosnode', 'list'], text=True).split()"
        assert kernel.run(names) == ["/rosout", "/student"]


def test_workspace_is_found_without_sourcing() -> None:
    """A kernel can import the course's types even if ROS's environment variables are not set."""
    bare = dict.fromkeys(("ROS_PACKAGE_PATH", "CMAKE_PREFIX_PATH", "ROS_MASTER_URI", "ROS_HOSTNAME"))
    with Kernel({**bare, "PYTHONPATH": str(Path(__file__).parents[2])}) as kernel:
        kernel.run(JOIN)
        assert (
            kernel.run("from course_pkg.srv import geometry; result = geometry._type")
            == "course_pkg/geometry"
        )


@pytest.mark.parametrize("uri", ["localhost:11311", "http://localhost", "http://localhost:port", "nonsense"])
def test_malformed_uri(uri: str) -> None:
    """If ROS_MASTER_URI is malformed, join() raises an error with an example."""
    with Kernel({"ROS_MASTER_URI": uri}) as kernel:
        reply = kernel.ask(JOIN)
        assert reply.error == "MalformedMasterUri"
        assert repr(uri) in reply.words
        assert "http://localhost:11311" in reply.words
        kernel.run("import os; del os.environ['ROS_MASTER_URI']")
        assert kernel.run(JOIN + "; result = node.name") == "/student"


def test_no_program_at_the_uri() -> None:
    """If no master is at the address in ROS_MASTER_URI, join() raises an error.

    After ROS_MASTER_URI was removed, join() works.
    """
    with Kernel({"ROS_MASTER_URI": "http://localhost:1"}) as kernel:
        reply = kernel.ask(JOIN)
        assert reply.error == "MasterUnreachable"
        assert "http://localhost:1" in reply.words
        kernel.run("import os; del os.environ['ROS_MASTER_URI']")
        assert kernel.run(JOIN + "; result = node.name") == "/student"


def test_silent_program_at_the_uri() -> None:
    """If the program at ROS_MASTER_URI sends nothing, join() raises an error within 4 s."""
    with socket.create_server(("127.0.0.1", 0)) as mute, Kernel() as kernel:
        uri = f"http://localhost:{mute.getsockname()[1]}"
        kernel.run(f"import os; os.environ['ROS_MASTER_URI'] = {uri!r}; from course_pkg.ros import join")
        reply = kernel.ask(JOIN)
        assert reply.error == "MasterSilent"
        assert reply.took < 4


def test_another_program_at_the_uri(tmp_path: Path) -> None:
    """If a web server is at the address ROS_MASTER_URI, join() raises NotAMaster."""
    command = [sys.executable, "-u", "-m", "http.server", "-b", "127.0.0.1", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, cwd=tmp_path) as web:
        assert web.stdout is not None
        port = web.stdout.readline().split(b"port ")[1].split()[0].decode()
        with Kernel({"ROS_MASTER_URI": f"http://localhost:{port}"}) as kernel:
            assert kernel.ask(JOIN).error == "NotAMaster"
        web.terminate()


def test_two_kernels_with_one_name(kernel: Kernel) -> None:
    """If two kernels use the same name at the same time, the second kernel gets an error from join()."""
    kernel.run(JOIN)
    with Kernel() as second:
        reply = second.ask(JOIN)
        assert reply.error == "NodeNameTaken"
        assert "/student" in reply.words
        assert second.run("node = join('student_2'); result = node.name") == "/student_2"
    assert kernel.run("import rospy; result = rospy.is_shutdown()") is False


def test_name_of_a_killed_kernel_is_free(master: PrivateMaster) -> None:
    """After SIGKILL of a kernel, a new kernel can use the same name."""
    former = Kernel()
    former.run(
        JOIN + "\nfrom std_srvs.srv import Empty; import rospy; rospy.Service('/former', Empty, print)"
    )
    former.kill()
    former.exit()
    with Kernel() as kernel:
        kernel.run(JOIN)
        assert "/former" not in MasterClient(master.uri).system_state().services


def test_another_name_in_the_same_kernel(kernel: Kernel) -> None:
    """join() with a second name raises an error, because a process can be only one node."""
    kernel.run(JOIN)
    reply = kernel.ask("join('other')")
    assert reply.error == "NotJoined"
    assert "join('student')" in reply.words
    assert kernel.run("result = node.name") == "/student"


@pytest.mark.parametrize("name", ["", "1st", "two words", "a/b"])
def test_illegal_name(kernel: Kernel, name: str) -> None:
    """If the name of the node is invalid, join() raises an error."""
    assert kernel.ask(f"from course_pkg.ros import join\njoin({name!r})").error == "NotJoined"


def test_join_on_another_thread_is_refused(kernel: Kernel) -> None:
    """join() raises an error on a second thread, and a later join() on the main thread works."""
    kernel.run("""
        import threading
        from course_pkg.errors import NotJoined
        from course_pkg.ros import join
        result = []
        def attempt():
            try:
                join("student")
            except NotJoined as error:
                result.append(str(error))
        thread = threading.Thread(target=attempt)
        thread.start()
        thread.join()
        assert result, "not refused"
        node = join("student")
    """)


def test_private_master_killed() -> None:
    """If the kernel's private master was killed, the next call of join() starts a new master."""
    with Kernel({"ROS_MASTER_URI": None}) as kernel:
        kernel.run(JOIN)
        uri = kernel.run("""
            import rospy
            from std_msgs.msg import UInt32
            from std_srvs.srv import Trigger
            raw = rospy.Service("/raw", Trigger, lambda request: (True, "raw"))
            publisher = rospy.Publisher("/numbers", UInt32, queue_size=1, latch=True)
            publisher.publish(7)
            heard = node.subscribe("/numbers", UInt32)
            heard.wait(1)
            result = node.master
        """)
        os.kill(MasterClient(uri).pid(), signal.SIGKILL)
        reply = kernel.ask("node.call('/raw', Trigger)")
        assert (reply.error, reply.words) == ("ServiceException", "unable to contact master")
        assert kernel.ask("node.subscribe('/more', UInt32)").error == "MasterUnreachable"
        kernel.run("node = join('student')")
        assert kernel.run("result = node.call('/raw', Trigger).message") == "raw"
        seen = look(uri)
        assert [topic.name for topic in seen.topics if topic.subscribers] == ["/numbers", "/rosout"]
        published = [topic.name for topic in seen.topics if topic.publishers]
        assert published == ["/numbers", "/rosout", "/rosout_agg"]
        assert (
            kernel.run(
                "raw2 = rospy.Service('/raw2', Trigger, lambda r: (True, '2'))\n"
                "result = node.call('/raw2', Trigger).message"
            )
            == "2"
        )


def test_shared_master_restarted() -> None:
    """If a shared master was restarted, the next call of join() registers the services and topics again."""
    with PrivateMaster() as master, Kernel({"ROS_MASTER_URI": master.uri}) as kernel:
        kernel.run(JOIN)
        kernel.run(
            "import rospy; from std_srvs.srv import Trigger\n"
            "rospy.Service('/served', Trigger, lambda request: (True, 'here'))"
        )
        master.stop()
        assert kernel.ask("join('student')").error == "MasterUnreachable"
        with PrivateMaster(master.port):
            kernel.run("join('student')")
            assert kernel.run("result = node.call('/served', Trigger).message") == "here"


def test_moving_to_another_master() -> None:
    """If a shared master has ended, the next call of join() starts a private master."""
    with PrivateMaster() as master, Kernel({"ROS_MASTER_URI": master.uri}) as kernel:
        kernel.run(JOIN)
        kernel.run(
            "import rospy; from std_srvs.srv import Trigger\n"
            "rospy.Service('/served', Trigger, lambda request: (True, 'here'))"
        )
        master.stop()
        kernel.run("import os; del os.environ['ROS_MASTER_URI']; join('student')")
        assert kernel.run("result = node.master") != master.uri
        kernel.run("raw = rospy.Service('/raw', Trigger, lambda request: (True, 'raw'))")
        assert kernel.run("result = [node.call(name, Trigger).message for name in ('/served', '/raw')]") == [
            "here",
            "raw",
        ]


def test_stopped_master(kernel: Kernel, master: PrivateMaster) -> None:
    """While the master is suspended with SIGSTOP, requests time out. After SIGCONT, requests work again."""
    kernel.run(JOIN + "; from std_msgs.msg import UInt32")
    with stopped(master.pid):
        for cell in ("join('student')", "node.subscribe('/x', UInt32)"):
            reply = kernel.ask(cell)
            assert reply.error == "MasterSilent", (cell, reply)
            assert reply.took < 4
    kernel.run("node.subscribe('/x', UInt32)")


def test_exit_while_the_master_is_stopped() -> None:
    """A kernel exits within 12 s, even if its master does not respond."""
    with PrivateMaster() as own:
        kernel = Kernel({"ROS_MASTER_URI": own.uri})
        kernel.run(JOIN)
        kernel.run("""
            import rospy
            from std_msgs.msg import UInt32
            from std_srvs.srv import Trigger
            heard = node.subscribe("/numbers", UInt32)
            served = [rospy.Service(f"/served_{number}", Trigger, print) for number in range(5)]
            processes = [node.run("course_pkg", "pulse", name=f"pulse_{number}") for number in range(3)]
            processes[-1].wait_for_service("/pulse_2/get_loggers")
        """)
        with stopped(own.pid):
            kernel.exit(timeout=12)


def test_leaving_and_coming_back(kernel: Kernel, master: PrivateMaster) -> None:
    """After leave(), a kernel can call join() again, and can then offer services."""
    kernel.run(
        JOIN
        + """
import rospy
from std_srvs.srv import Trigger
from std_msgs.msg import UInt32
rospy.Service("/mine", Trigger, lambda request: (True, "here"))
node.subscribe("/numbers", UInt32)
server = node.run("course_pkg", "server")
server.wait_for_service("/getGeometry")
node.leave()
result = server.running
"""
    )
    assert MasterClient(master.uri).system_state().nodes == ()
    kernel.run("node = join('student'); rospy.Service('/more', Trigger, lambda request: (True, 'again'))")
    assert kernel.run("result = node.call('/more', Trigger).message") == "again"


def test_leaving_is_prompt(kernel: Kernel) -> None:
    """leave() is fast, because it does not wait for rospy's threads."""
    kernel.run(JOIN)
    assert kernel.ask("node.leave()").took < 0.3
    started = time.monotonic()
    kernel.exit()
    assert time.monotonic() - started < 2


def test_root_logger_is_not_changed(kernel: Kernel) -> None:
    """join() does not change the root logger."""
    assert kernel.run("""
        import logging
        logging.basicConfig(level=logging.ERROR)
        before = logging.getLogger().handlers[:]
        from course_pkg.ros import join
        join("student")
        root = logging.getLogger()
        result = root.handlers == before, root.level == logging.ERROR
    """) == [True, True]


def test_log_of_a_handler_is_not_printed_in_the_cell(master: PrivateMaster) -> None:
    """The log messages of a handler go to the node's log file, and are not printed in the cell."""
    kernel = Kernel()
    kernel.run(
        JOIN
        + """
import rospy
from std_srvs.srv import Trigger
raw = rospy.Service("/raw", Trigger, lambda request: rospy.logerr("from the handler") or 1 / 0)
try:
    node.call("/raw", Trigger)
except rospy.ServiceException:
    pass
rospy.loginfo("from the cell")
"""
    )
    log = Path(os.environ["ROS_LOG_DIR"]) / "student.log"
    eventually(lambda: "division by zero" in log.read_text())
    printed = kernel.exit()
    assert "from the cell" in printed
    assert "from the handler" not in printed
    assert "division by zero" not in printed
    assert "from the handler" in log.read_text()


SPIN = """
import os, signal, threading
threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
rospy.spin()
"""


@pytest.mark.parametrize("how", ["rospy.signal_shutdown('test')", SPIN], ids=["signal_shutdown", "spin"])
def test_node_that_was_shut_down_starts_again(kernel: Kernel, master: PrivateMaster, how: str) -> None:
    """After a shutdown, the node's methods raise an error until join() is called again."""
    kernel.run(
        JOIN
        + """
import rospy
from std_msgs.msg import UInt32
from std_srvs.srv import Trigger
heard = node.subscribe("/numbers", UInt32)
"""
    )
    kernel.run(how)
    assert kernel.run("result = rospy.is_shutdown()") is True
    for cell in ("node.subscribe('/x', UInt32)", "node.run('course_pkg', 'server')"):
        reply = kernel.ask(cell)
        assert reply.error == "NotJoined"
        assert "Run the set-up cell" in reply.words
    assert kernel.run("result = join('student') is node, rospy.is_shutdown()") == [True, False]
    kernel.run("""
        publisher = rospy.Publisher("/numbers", UInt32, queue_size=1, latch=True)
        publisher.publish(7)
        assert heard.wait(1)[0].data == 7
        raw = rospy.Service("/raw", Trigger, lambda request: (True, "raw"))
        assert node.call("/raw", Trigger).message == "raw"
    """)
    kernel.exit()
    assert MasterClient(master.uri).system_state().nodes == ()


def test_forked_child_is_not_the_node(kernel: Kernel) -> None:
    """When a forked child exits, the parent's services stay registered."""
    assert kernel.run(
        JOIN
        + """
import os
import rospy
from course_pkg.errors import NotJoined
from std_srvs.srv import Trigger
rospy.Service("/served", Trigger, lambda request: (True, "here"))
child = os.fork()
if child == 0:
    try:
        node.call("/served", Trigger)
    except NotJoined:
        import atexit
        atexit._run_exitfuncs()
        os._exit(7)
    os._exit(1)
status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
result = status, node.call("/served", Trigger).message
"""
    ) == [7, "here"]
