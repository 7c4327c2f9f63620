"""A notebook shows an error in at most 12 lines."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.notebook_kernel import NotebookKernel

HEADER = "Traceback (most recent call last; %tb shows all of it):"
HANDLER = "Traceback of a handler or callback (most recent call last):"
MOST = 12


def without_cell_numbers(lines: list[str]) -> list[str]:
    """Return the lines of the traceback, with an asterisk in place of each cell number."""
    return [
        line.split("In[")[0] + "In[*]" + line.split("]", 1)[1] if "In[" in line else line for line in lines
    ]


def test_error_of_rospy(notebook: NotebookKernel) -> None:
    """The traceback shows the lines of the cells and the error message, but no lines of rospy."""
    notebook.run("def area():\n    return ask('/nope')\n")
    shown = notebook.run("print(1)\narea()")
    assert without_cell_numbers(shown.error_lines) == [
        HEADER,
        "  This cell, line 2",
        "    area()",
        "  Cell In[*], line 2, in area",
        "    return ask('/nope')",
        "  Cell In[*], line 9, in ask",
        "    return rospy.ServiceProxy(name, Trigger)().message",
        "ServiceException: service [/nope] unavailable",
    ]


def test_many_calls(notebook: NotebookKernel) -> None:
    """A long traceback shows only its first and its last calls."""
    notebook.run("def down(n):\n    return 1 / n + down(n - 1)")
    lines = without_cell_numbers(notebook.run("down(20)").error_lines)
    assert lines[1:4] == ["  This cell, line 1", "    down(20)", "  … 18 more calls …"]
    assert lines[-3:] == [
        "  Cell In[*], line 2, in down",
        "    return 1 / n + down(n - 1)",
        "ZeroDivisionError: division by zero",
    ]
    assert len(lines) <= MOST


def test_the_whole_traceback_on_request(notebook: NotebookKernel) -> None:
    """%tb and the other modes of %xmode also show the lines of rospy."""
    notebook.run("ask('/nope')")
    assert "tcpros_service.py" in "\n".join(notebook.run("%tb").traceback)
    notebook.run("%xmode Verbose")
    assert "tcpros_service.py" in "\n".join(notebook.run("ask('/nope')").traceback)
    notebook.run("%xmode Context")
    assert len(notebook.run("ask('/nope')").error_lines) < MOST


@pytest.mark.parametrize(
    "cell",
    [
        "x = = 1",
        "def f():\nreturn 1",
        "eval('1 +')",
        "import broken_by_student",
        "f'{1/0}'",
        "[1 / n for n in (1, 0)]",
        "def forever(): return forever()\nforever()",
        "raise ValueError('long ' * 1000)",
        "raise ValueError('line\\n' * 100)",
        "raise KeyboardInterrupt",
        "class Odd(Exception):\n    def __str__(self): raise ValueError\nraise Odd",
        "rospy.ServiceProxy('/x', Trigger)(1, 2)",
        "rospy.Service('/x', UInt32, print)",
        "rospy.Publisher('/x', UInt32).publish('y', 2)",
        "rospy.wait_for_service('/nope', timeout=0.1)",
        "rospy.get_param('/nope')",
        "join('other')",
        "node.call('/nope', Trigger)",
        "import json\njson.loads('{')",
        "%matplotlib nonsense",
        "%run nothing.py",
        "no_such_name",
        "import no_such_module",
    ],
)
def test_every_error_is_short(notebook: NotebookKernel, cell: str, tmp_path: Path) -> None:
    """Each error has at most 12 lines of 100 characters and contains the error's name."""
    (tmp_path / "broken_by_student.py").write_text("def f(:\n    pass\n")
    notebook.run(f"import sys; sys.path.insert(0, {str(tmp_path)!r})")
    shown = notebook.run(cell)
    lines = shown.error_lines or shown.err.splitlines()
    assert shown.ename or "UsageError" in shown.err
    assert sum(-(-len(line) // 100) or 1 for line in lines) <= MOST, lines
    assert not shown.ename or shown.ename in "".join(shown.traceback)


def test_error_while_handling_another(notebook: NotebookKernel) -> None:
    """If an `except` block raises an error, one line shows the earlier error that this block was handling."""
    shown = notebook.run("try:\n    {}['a']\nexcept KeyError:\n    raise ValueError('no a')")
    assert without_cell_numbers(shown.error_lines)[1] == "  (This cell, line 2, had raised KeyError: 'a')"
    assert shown.error_lines[-1] == "ValueError: no a"


def test_error_in_a_handler(notebook: NotebookKernel) -> None:
    """If a handler fails, the calling cell shows the failing line of the handler and the error message."""
    notebook.run(
        "def handle(request):\n    return 1 / 0\nservice = rospy.Service('/bad', Trigger, handle)", "bad"
    )
    shown = notebook.run("ask('/bad')")
    assert without_cell_numbers(shown.err.splitlines()) == [
        HANDLER,
        "  Cell In[*], line 2, in handle",
        "    return 1 / 0",
        "ZeroDivisionError: division by zero",
    ]
    assert "error processing request: division by zero" in shown.error_lines[-1]


def test_error_in_a_callback_is_shown_once_below_a_cell(notebook: NotebookKernel) -> None:
    """If a callback raises the same error several times while a cell runs, the cell shows the error once."""
    notebook.run(
        """
        called = []
        def callback(message):
            called.append(message.data)
            raise RuntimeError("in the callback")
        subscriber = rospy.Subscriber("/fails", UInt32, callback)
        publisher = rospy.Publisher("/fails", UInt32, queue_size=10)
        while not publisher.get_num_connections():
            rospy.sleep(0.01)
        """,
        "fails",
    )
    for _ in range(2):
        shown = notebook.run(
            "called.clear()\nwhile len(called) < 5:\n    publisher.publish(1)\n    rospy.sleep(0.02)"
        )
        assert without_cell_numbers(shown.err.splitlines()) == [
            HANDLER,
            "  Cell In[*], line 4, in callback",
            '    raise RuntimeError("in the callback")',
            "RuntimeError: in the callback",
        ]
    notebook.run("pass", "fails")


@pytest.mark.parametrize(
    "start",
    ["rospy.Timer(rospy.Duration(0.01), work, oneshot=True)", "threading.Thread(target=work).start()"],
)
def test_error_that_ends_a_thread(notebook: NotebookKernel, start: str) -> None:
    """A notebook shows an error in a thread or a timer in a few lines."""
    notebook.run("def work(*_):\n    failed.set()\n    1 / 0\nfailed = threading.Event()")
    shown = notebook.run(f"{start}\nfailed.wait()\nrospy.sleep(0.2)")
    assert without_cell_numbers(shown.err.splitlines()) == [
        HANDLER,
        "  Cell In[*], line 3, in work",
        "    1 / 0",
        "ZeroDivisionError: division by zero",
    ]
