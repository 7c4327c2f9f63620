"""Tests of cells that run again and that create services, topics or timers with plain rospy."""

from __future__ import annotations

import textwrap
import threading
from weakref import WeakSet

import pytest

from course_pkg.ros import MasterClient, PrivateMaster
from course_pkg.ros.notebook.cells import CellRun
from tests.notebook_kernel import NotebookKernel, Shown
from tests.support import eventually

REPLACES = "The service {} of this cell replaces the service that another cell created.\n"


def value(notebook: NotebookKernel, code: str) -> str:
    """Run a cell without an id, and return the repr of its value."""
    shown = notebook.run(code)
    assert not shown.ename, shown.evalue
    return shown.results[-1]


def silent(shown: Shown) -> None:
    """Assert that a cell had no output."""
    assert shown == Shown(), shown


def test_service_cell_runs_again(notebook: NotebookKernel) -> None:
    """After a second run of the cell, the new handler responds."""
    for answer in ("first", "second"):
        silent(
            notebook.run(f"service = rospy.Service('/again', Trigger, lambda r: (True, '{answer}'))", "again")
        )
        assert value(notebook, "ask('/again')") == repr(answer)


def test_class_that_serves_in_init(notebook: NotebookKernel) -> None:
    """A service that a class creates in `__init__` belongs to the cell that creates the object."""
    notebook.run(
        """
        class Counter:
            def __init__(self, start):
                self.count = start
                self.service = rospy.Service("/counter", Trigger, self.handle)
                self.timer = rospy.Timer(rospy.Duration(10), print)

            def handle(self, request):
                self.count += 1
                return True, str(self.count)
        """,
        "class",
    )
    for start in (0, 10):
        silent(notebook.run(f"counter = Counter({start})", "object"))
        assert value(notebook, "ask('/counter')") == repr(str(start + 1))


def test_subscriber_cell_runs_again(notebook: NotebookKernel) -> None:
    """After three runs of the cell, the callback is called once for each message."""
    notebook.run("publisher = rospy.Publisher('/numbers', UInt32, queue_size=9)", "publisher")
    cell = (
        "received = []\nsubscriber = rospy.Subscriber('/numbers', UInt32, lambda m: received.append(m.data))"
    )
    for _ in range(3):
        silent(notebook.run(cell, "subscriber"))
    publish = """
    for number in range(1000):
        publisher.publish(number)
        rospy.sleep(0.01)
        if len(received) >= 5:
            break
    len(received) >= 5 and len(received) == len(set(received))
    """
    assert value(notebook, publish) == "True"


def test_publisher_and_subscriber_leave_the_graph(notebook: NotebookKernel, master: PrivateMaster) -> None:
    """If the cell runs again without the line that creates a publisher, the old publisher is unregistered."""
    cell = """
    publisher = rospy.Publisher("/left", UInt32, queue_size=1)
    subscriber = rospy.Subscriber("/left", UInt32, print)
    """
    notebook.run(cell, "left")
    state = MasterClient(master.uri).system_state()
    assert "/left" in state.publishers
    assert "/left" in state.subscribers
    notebook.run("pass", "left")
    state = MasterClient(master.uri).system_state()
    assert "/left" not in state.publishers
    assert "/left" not in state.subscribers


def test_timer_cell_runs_again(notebook: NotebookKernel) -> None:
    """After a second run of the cell, only the new timer calls its callback."""
    for number in (1, 2):
        notebook.run(
            f"calls = []\ntimer = rospy.Timer(rospy.Duration(0.01), lambda _: calls.append({number}))",
            "timer",
        )
    assert value(notebook, "while len(calls) < 9: rospy.sleep(0.01)\nset(calls)") == "{2}"
    notebook.run("pass", "timer")


def test_action_server_cell_runs_again(notebook: NotebookKernel, master: PrivateMaster) -> None:
    """After a second run of the cell, only the new action server executes goals."""
    notebook.run("import actionlib\nfrom actionlib_msgs.msg import GoalStatus\nfrom course_pkg import msg")
    cell = """
    def execute(goal):
        server.set_succeeded(msg.FetchResult(), "ANSWER")
    server = actionlib.SimpleActionServer("/fetch", msg.FetchAction, execute, auto_start=False)
    server.start()
    """
    for answer in ("first", "second"):
        silent(notebook.run(textwrap.dedent(cell).replace("ANSWER", answer), "action"))
    client = """
    client = actionlib.SimpleActionClient("/fetch", msg.FetchAction)
    assert client.wait_for_server(rospy.Duration(5))
    client.send_goal_and_wait(msg.FetchGoal(), rospy.Duration(5))
    client.get_goal_status_text()
    """
    assert value(notebook, client) == "'second'"
    loops = "len([t for t in threading.enumerate() if 'executeLoop' in t.name])"
    assert value(notebook, loops) == "1"
    notebook.run("pass", "action")
    assert value(notebook, loops) == "0"
    assert "/fetch/goal" not in MasterClient(master.uri).system_state().subscribers


def test_two_cells_with_one_service(notebook: NotebookKernel) -> None:
    """If two cells offer the same service, the later service replaces the earlier one."""
    serve = "service = rospy.Service('/shared', Trigger, lambda r: (True, '{}'))"
    silent(notebook.run(serve.format("one"), "one"))
    for cell in ("two", "one", "two"):
        assert notebook.run(serve.format(cell), cell) == Shown(out=REPLACES.format("/shared"))
        assert value(notebook, "ask('/shared')") == repr(cell)
    silent(notebook.run("pass", "one"))
    assert value(notebook, "ask('/shared')") == "'two'"


def test_one_cell_with_one_service_twice(notebook: NotebookKernel) -> None:
    """If one run of a cell offers a service twice, rospy refuses the second service."""
    cell = "rospy.Service('/twice', Trigger, print)\nrospy.Service('/twice', Trigger, print)"
    shown = notebook.run(cell, "twice")
    assert (shown.ename, shown.evalue) == ("ServiceException", "service [/twice] already registered")
    silent(notebook.run("rospy.Service('/twice', Trigger, print);", "twice"))


def test_cells_without_ids(notebook: NotebookKernel) -> None:
    """If cells have no ids, each execution counts as a separate cell."""
    serve = "service = rospy.Service('/no_id', Trigger, lambda r: (True, ''))"
    silent(notebook.run(serve))
    assert notebook.run(serve) == Shown(out=REPLACES.format("/no_id"))


def test_creation_in_a_handler_belongs_to_no_cell(notebook: NotebookKernel, master: PrivateMaster) -> None:
    """A publisher that a handler creates belongs to no cell, so no cell removes it."""
    cell = """
    def handle(request):
        global made
        made = rospy.Publisher("/made_by_handler", UInt32, queue_size=1)
        return True, ""
    maker = rospy.Service("/make", Trigger, handle)
    """
    notebook.run(cell, "maker")
    for _ in range(2):
        notebook.run("ask('/make')", "caller")
    notebook.run("pass", "caller")
    assert "/made_by_handler" in MasterClient(master.uri).system_state().publishers


def test_creation_in_a_thread_of_the_cell(notebook: NotebookKernel) -> None:
    """A service that a cell's thread creates belongs to this cell."""
    cell = """
    def work():
        global service
        service = rospy.Service("/threaded", Trigger, lambda r: (True, "ANSWER"))
    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    """
    for answer in ("first", "second"):
        silent(notebook.run(textwrap.dedent(cell).replace("ANSWER", answer), "thread"))
        assert value(notebook, "ask('/threaded')") == repr(answer)


def test_new_thread_with_the_identifier_of_an_ended_thread() -> None:
    """A new thread belongs to the run of the cell, even if an ended thread had the same identifier."""
    owned: list[bool] = []

    def new_thread(run: CellRun) -> int:
        thread = threading.Thread(target=lambda: owned.append(run.owns_this_thread()))
        thread.start()
        thread.join()
        assert thread.ident is not None
        return thread.ident

    def earlier_thread() -> tuple[CellRun, int]:
        release = threading.Event()
        thread = threading.Thread(target=release.wait)
        thread.start()
        run = CellRun(threads=WeakSet([thread]))
        release.set()
        thread.join()
        assert thread.ident is not None
        return run, thread.ident

    # Linux usually gives the identifier of the thread that ended last to the next thread.
    for _ in range(100):
        run, identifier = earlier_thread()
        if new_thread(run) == identifier:
            break
    else:
        pytest.fail("no new thread got the identifier of an ended thread")
    assert owned[-1]


def test_persistent_proxy_of_a_replaced_service(notebook: NotebookKernel) -> None:
    """After the service was replaced, a call through an old persistent proxy raises an error with advice."""
    serve = "service = rospy.Service('/kept', Trigger, lambda r: (True, ''))"
    notebook.run(serve, "kept")
    notebook.run("proxy = rospy.ServiceProxy('/kept', Trigger, persistent=True)\nproxy()", "proxy")
    notebook.run(serve, "kept")
    assert "Create the persistent proxy again" in notebook.run("proxy()").evalue


def test_cell_within_a_cell(notebook: NotebookKernel) -> None:
    """If a cell begins with %%capture, the service that its code creates belongs to this cell."""
    cell = "%%capture\nservice = rospy.Service('/captured', Trigger, lambda r: (True, ''))"
    silent(notebook.run(cell, "captured"))
    silent(notebook.run(cell, "captured"))


def test_join_again_keeps_the_nodes_own_services(notebook: NotebookKernel, master: PrivateMaster) -> None:
    """If join() is called again, /rosout and the logger services stay registered."""
    for _ in range(2):
        silent(notebook.run("node = join('student')", "join"))
    state = MasterClient(master.uri).system_state()
    assert "/student" in state.publishers["/rosout"]
    assert "/student/get_loggers" in state.services


def test_init_node_after_join(notebook: NotebookKernel) -> None:
    """After join(), init_node() with valid arguments has no effect."""
    for arguments in ("'listener'", "'listener', anonymous=True", "'student', disable_signals=True"):
        silent(notebook.run(f"rospy.init_node({arguments})"))
    assert value(notebook, "rospy.get_name()") == "'/student'"
    assert notebook.run("rospy.init_node('a/b')").ename == "ValueError"


def test_cell_that_runs_again_without_a_master() -> None:
    """If there is no master, a cell that offers a service can still run again.

    After a new master has started, the cell's service works again.
    """
    with PrivateMaster() as master, NotebookKernel({"ROS_MASTER_URI": master.uri}) as kernel:
        kernel.run("import rospy\nfrom std_srvs.srv import Trigger\nfrom course_pkg import join")
        kernel.run("node = join('student')", "join")
        serve = "service = rospy.Service('/lost', Trigger, lambda r: (True, 'here'))"
        silent(kernel.run(serve, "serve"))
        master.stop()
        silent(kernel.run("pass", "serve"))
        with PrivateMaster(master.port) as again:
            silent(kernel.run("node = join('student')", "join"))
            silent(kernel.run(serve, "serve"))
            eventually(lambda: "/lost" in MasterClient(again.uri).system_state().services)


def test_kernel_ends_although_it_has_an_action_server(master: PrivateMaster) -> None:
    """A kernel with an action server can exit."""
    with NotebookKernel() as kernel:
        kernel.run("import actionlib\nfrom course_pkg import join, msg\nnode = join('acting')")
        kernel.run("server = actionlib.SimpleActionServer('/act', msg.FetchAction, print, auto_start=False)")
        kernel.run("server.start()")
        kernel.client.shutdown()
        eventually(lambda: not kernel.manager.is_alive(), 5)
