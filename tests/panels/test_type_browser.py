"""Tests of the type browser: the types, their fields, and the nodes that use them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from course_pkg.panels import TypeBrowser
from course_pkg.panels.types.model import (
    CHANGED,
    NO_FILE,
    UNBUILT,
    TypeModel,
    catalogue,
    described,
    offers,
    packages,
)
from course_pkg.ros import NodeProcess, NodeSeen, PrivateMaster, ServiceSeen, Snapshot, TopicSeen
from course_pkg.types import Plain
from tests.support import eventually
from tests.types.conftest import build, package


class Wall:
    """Stores the messages of a model; the parts of a message are keyword arguments."""

    def __init__(self) -> None:
        self.said: list[dict[str, Plain]] = []
        self.model = TypeModel(lambda **parts: self.said.append(parts))

    def last(self, name: str) -> Plain:
        """Return the latest value that the model has sent with the given keyword."""
        return next(each[name] for each in reversed(self.said) if name in each)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a temporary folder that is on ROS_PACKAGE_PATH; its subfolder python is on sys.path."""
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path), prepend=":")
    monkeypatch.syspath_prepend(str(tmp_path / "python"))
    return tmp_path


def test_a_service_type_has_fields_comments_and_lines() -> None:
    """The browser shows the fields, the MD5 sum, the text and the commands of a service type."""
    told = described("std_srvs/SetBool", "srv")
    request, response = told["parts"]
    assert [(each["type"], each["name"]) for each in request["fields"]] == [("bool", "data")]
    assert request["fields"][0]["help"] == "e.g. for hardware enabling / disabling"
    assert [each["name"] for each in response["fields"]] == ["success", "message"]
    assert told["md5"] == "09fb03525b03e7ea1fd3992bafd87e16"
    assert "---\n" in told["text"]
    assert told["file"].endswith("std_srvs/srv/SetBool.srv")
    assert [each["text"] for each in told["lines"]] == [
        "rossrv show std_srvs/SetBool",
        "rossrv md5 std_srvs/SetBool",
        "from std_srvs.srv import SetBool",
    ]
    assert (told["problem"], told["warning"]) == ("", "")


def test_nested_messages_are_a_tree_and_constants_are_listed() -> None:
    """The browser shows nested messages with their fields, and lists constants."""
    [fields] = described("rosgraph_msgs/Log", "msg")["parts"]
    header = fields["fields"][0]
    assert (header["type"], [each["name"] for each in header["fields"]]) == (
        "std_msgs/Header",
        ["seq", "stamp", "frame_id"],
    )
    assert [each["name"] for each in header["fields"][1]["fields"]] == ["secs", "nsecs"]
    assert {"name": "ERROR", "type": "byte", "value": "8"} in fields["constants"]
    [points] = described("geometry_msgs/Polygon", "msg")["parts"]
    assert [each["name"] for each in points["fields"][0]["fields"]] == ["x", "y", "z"]


def test_the_error_in_a_broken_file_has_its_line(folder: Path) -> None:
    """If a definition is invalid, the browser shows the error, the line number, and the file."""
    package(folder, "bad_pkg", Slip_srv="float64 ok\nfloat64 side;\n---\n")
    told = described("bad_pkg/Slip", "srv")
    assert "bad_pkg/srv/Slip.srv, line 2" in told["problem"]
    assert told["text"].startswith("float64 ok")
    assert told["parts"] == []


def test_a_type_that_is_not_built_says_so(folder: Path) -> None:
    """If a definition is not built, the browser shows a note."""
    package(folder, "raw_types_pkg", New_srv="int8 x\n---\n")
    told = described("raw_types_pkg/New", "srv")
    assert told["warning"] == UNBUILT
    assert told["parts"][0]["fields"][0]["name"] == "x"


def test_a_file_that_changed_since_it_was_built(folder: Path) -> None:
    """If the definition file differs from the built type, the browser shows a note.

    If only a comment has changed, the browser shows no note.
    """
    root = package(folder, "made_pkg", Made_srv="int8 x\n---\n", Whole_msg="int8 y\n")
    build(root, folder / "python")
    file = root / "srv" / "Made.srv"
    assert described("made_pkg/Made", "srv")["warning"] == ""
    file.write_text("int8 x  # how far\n---\n")
    assert described("made_pkg/Made", "srv")["warning"] == ""
    file.write_text("int16 x\n---\n")
    told = described("made_pkg/Made", "srv")
    assert told["warning"] == CHANGED
    assert told["parts"][0]["fields"][0]["type"] == "int8"
    assert told["text"].startswith("int16")
    file.write_text("int16 x;\n---\n")
    assert f"{file}, line 1" in described("made_pkg/Made", "srv")["warning"]
    file.unlink()
    assert described("made_pkg/Made", "srv")["warning"] == NO_FILE


@pytest.mark.parametrize("name", ["std_srvs/Nothing", "nonsense", "a/b/c", "<script>/x"])
def test_a_type_that_is_not_there(name: str) -> None:
    """If a name is unknown, the page shows similar names or gives other advice."""
    told = described(name, "srv")
    assert name in told["problem"]
    assert (told["parts"], told["md5"]) == ([], "")


def test_packages_are_those_with_types() -> None:
    """For each package, the browser lists the service types and message types in alphabetical order."""
    found = packages((("b_pkg/One", "b_pkg/Two"), ("a_pkg/Three", "b_pkg/One")))
    assert found == [
        {"name": "a_pkg", "srv": [], "msg": ["Three"]},
        {"name": "b_pkg", "srv": ["One", "Two"], "msg": ["One"]},
    ]


def test_everything_on_the_path_can_be_opened() -> None:
    """The browser can open every type on this machine."""
    services, messages = catalogue()
    assert {"std_srvs/SetBool", "course_pkg/geometry"} <= set(services)
    assert "std_msgs/String" in messages
    assert [name for name in services if described(name, "srv")["problem"]] == []


def test_a_changed_file_is_reported(folder: Path) -> None:
    """When a file changes, the page shows the change without a click."""
    wall = Wall()
    root = package(folder, "short_pkg", Lived_srv="int8 x\n---\n")
    wall.model.update(catalogue())
    wall.model.open("short_pkg/Lived")
    assert wall.last("described")["problem"] == ""
    (root / "srv" / "Lived.srv").unlink()
    wall.model.update(catalogue())
    assert "short_pkg/Lived" in wall.last("described")["problem"]
    assert all(each["srv"] != ["Lived"] for each in wall.last("packages"))


def test_an_unchanged_type_is_not_sent_again() -> None:
    """If no file has changed, the model sends nothing."""
    wall = Wall()
    wall.model.update(catalogue())
    wall.model.open("std_srvs/Empty")
    told = len(wall.said)
    wall.model.update(catalogue())
    assert len(wall.said) == told


def test_a_name_of_both_halves_is_the_service() -> None:
    """If a service type and a message type have the same name, the browser opens the service type."""
    wall = Wall()
    wall.model.update((("std_srvs/Empty",), ("std_msgs/Empty", "std_srvs/Empty")))
    wall.model.open("std_srvs/Empty")
    assert wall.last("described")["half"] == "srv"
    wall.model.open("std_msgs/Empty")
    assert wall.last("described")["half"] == "msg"


def test_who_offers_a_type_now() -> None:
    """For a type, the browser lists the services or topics that use this type."""
    seen = Snapshot(
        "http://localhost:11311",
        (NodeSeen("/a", "x", "answered"),),
        (TopicSeen("/t", "std_msgs/String", ("/a",), ("/b", "/c")), TopicSeen("/untyped", "", (), ("/b",))),
        (
            ServiceSeen("/s", "std_srvs/Empty", "/a", "x", "answered"),
            ServiceSeen("/mute", "", "/d", "x", "silent"),
        ),
    )
    assert offers(seen) == {
        "srv": {"std_srvs/Empty": [{"name": "/s", "served by": ["/a"]}]},
        "msg": {"std_msgs/String": [{"name": "/t", "published by": ["/a"], "subscribed by": ["/b", "/c"]}]},
    }


@pytest.fixture
def browser(master: PrivateMaster) -> Iterator[TypeBrowser]:
    """Yield a visible browser on a real master."""
    assert master.uri
    browser = TypeBrowser("course_pkg/geometry")
    browser._dispatch(browser, {"kind": "hello", "view": "a"}, [])
    yield browser
    browser.close()


def test_it_follows_the_graph_and_the_files(browser: TypeBrowser, folder: Path) -> None:
    """A visible browser shows a new server and a new file."""
    with NodeProcess.rosrun("course_pkg", "server"):
        who = eventually(lambda: browser.offers.get("srv", {}).get("course_pkg/geometry"), timeout=20)
    assert who == [{"name": "/getGeometry", "served by": ["/SERVER_NODE"]}]
    package(folder, "late_types_pkg", Late_srv="int8 x\n---\n")
    eventually(lambda: any(each["name"] == "late_types_pkg" for each in browser.packages), timeout=20)
    browser._dispatch(browser, {"kind": "open", "name": "late_types_pkg/Late", "half": "srv"}, [])
    (folder / "late_types_pkg" / "srv" / "Late.srv").write_text("int8 y\n---\n")
    eventually(lambda: browser.described["parts"][0]["fields"][0]["name"] == "y", timeout=20)
    assert browser.notice == ""


def test_the_repr_is_stable(browser: TypeBrowser) -> None:
    """The repr of the browser is the same before and after clicks."""
    browser._dispatch(browser, {"kind": "open", "name": "std_srvs/Empty", "half": "srv"}, [])
    assert browser.described["name"] == "std_srvs/Empty"
    assert (repr(browser), repr(TypeBrowser())) == ("TypeBrowser('course_pkg/geometry')", "TypeBrowser()")


def test_without_a_master_types_can_be_read(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a master, the browser shows the types, and says why no nodes are listed."""
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    browser = TypeBrowser("std_srvs/Trigger")
    assert browser.described["md5"] == "937c9679a518e3a18d831e57125ea522"
    assert "No ROS master at http://localhost:1" in browser.trouble
