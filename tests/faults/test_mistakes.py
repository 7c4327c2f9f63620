"""Tests of the table of mistakes: the tests cause each mistake and check the explanation of the symptom."""

from __future__ import annotations

import subprocess
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest
from _pytest.mark import ParameterSet

from course_pkg.faults import caused, names
from course_pkg.ros import MasterClient, PrivateMaster, explain
from tests.faults.mistakes import COUNTS, ROWS, Builds, Shows
from tests.faults.surroundings import Surroundings
from tests.support import eventually, usual
from tests.workspace.packages import GOOD, build, shell, spoilt, write

SHOWN = [each for row in ROWS for each in row.shown if isinstance(each, Shows)]
BUILT = [each for row in ROWS for each in row.shown if isinstance(each, Builds)]


def _params() -> Iterator[ParameterSet]:
    """Yield all faults; in each section, all faults except the first four are marked as slow tests."""
    for section in COUNTS:
        rows = [row for row in ROWS if row.section == section]
        shown = [each for row in rows for each in row.shown if isinstance(each, Shows)]
        yield from usual(4, {each.fault: each for each in shown})


def test_the_table_is_complete() -> None:
    """Each section of the table has the expected number of rows, and each row has a fault or a build."""
    assert Counter(row.section for row in ROWS) == COUNTS
    assert all(row.shown for row in ROWS)


def test_the_table_names_exactly_the_faults_of_the_course() -> None:
    """The table and the course contain the same faults."""
    assert sorted(each.fault for each in SHOWN) == sorted(names())


def test_each_fault_prints_something_or_hangs() -> None:
    """For each fault, the table contains an expected output, or says that the client waits forever."""
    assert all(each.said or each.server or each.hangs for each in SHOWN)


@pytest.mark.parametrize("shows", list(_params()))
def test_a_fault_is_caused_seen_explained_and_undone(master: PrivateMaster, shows: Shows) -> None:
    """Each fault causes the symptom that the table contains, and `explain` explains this symptom."""
    assert master.uri
    before = Surroundings()
    with caused(shows.fault) as stage:
        seen = stage.symptom()
        keeper = stage.keeper
        printed = eventually(lambda: keeper.output() if keeper else " ") if shows.server else ""
    assert not before.left_behind()
    assert seen.waiting == shows.hangs, seen
    assert shows.said in seen.said
    assert shows.server in printed
    if shows.cause:
        explained = [explain.explain(text) for text in (seen.said, printed)]
        assert any(each.known and shows.cause in each.cause for each in explained), explained


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Create a workspace with a correct package, and with scripts that rosrun cannot run."""
    folder = tmp_path_factory.mktemp("mistakes")
    scripts = {"scripts/plain.py": "print(1)\n", "scripts/shell.py": "import os\n"}
    write(folder, {**GOOD, **scripts})
    (folder / "src" / "my_services" / "scripts" / "shell.py").chmod(0o755)
    assert build(folder)[0] == 0
    return folder


FIND = "find_package(catkin REQUIRED COMPONENTS message_generation)\n"
ADD, GENERATE = "add_service_files(FILES Box.srv)\n", "generate_messages()\n"
PACKAGE = "catkin_package(CATKIN_DEPENDS message_runtime)\n"
SPOILT = {
    "no message_generation": ("CMakeLists.txt", (" COMPONENTS message_generation", "")),
    "generated too early": ("CMakeLists.txt", (ADD, ""), (GENERATE, GENERATE + ADD)),
    "generated too late": ("CMakeLists.txt", (GENERATE, ""), (PACKAGE, PACKAGE + GENERATE)),
    "wrong file": ("CMakeLists.txt", ("Box.srv", "Bocks.srv")),
    "blanks in the dashes": ("srv/Box.srv", ("---", "- - -")),
}
LINES = {
    "not sourced: Python": ("python3 -c 'import my_services'", False),
    "not sourced: rospack": ("rospack find my_services", False),
    "wrong case": ("python3 -c 'from my_services.srv import box'", True),
    "roslaunch for rosrun": ("roslaunch my_services plain", True),
    "rosservice show": ("rosservice show /box", True),
    "no run bit": ("rosrun my_services plain.py", True),
    "no shebang": ("rosrun my_services shell.py", True),
}


def printed(built: Builds, workspace: Path, tmp_path: Path) -> str:
    """Run a command that contains the mistake, and return its output."""
    if built.slip in LINES:
        line, sourced = LINES[built.slip]
        return shell(workspace, line, sourced=sourced)
    if built.slip == "another Python":
        subprocess.run(["python3", "-m", "venv", "--without-pip", tmp_path / "other"], check=True)
        write(tmp_path, GOOD)
        return build(tmp_path, path=str(tmp_path / "other" / "bin"))[1]
    if built.slip == "not generated":
        write(tmp_path, spoilt("CMakeLists.txt", (GENERATE, f"# {GENERATE}")))
        assert build(tmp_path)[0] == 0
        return shell(tmp_path, "python3 -c 'from my_services.srv import Box'")
    file, *changes = SPOILT[built.slip]
    write(tmp_path, spoilt(file, *changes))
    return build(tmp_path)[1]


@pytest.mark.parametrize("built", usual(4, {each.slip: each for each in BUILT}))
def test_a_mistake_in_a_build_is_explained(built: Builds, workspace: Path, tmp_path: Path) -> None:
    """The command's output contains the expected text, and `explain` explains the output."""
    text = printed(built, workspace, tmp_path)
    assert " ".join(built.said.split()) in " ".join(text.split())
    explained = explain.explain(text)
    assert explained.known
    assert built.cause in explained.cause


def test_two_cases_run_on_one_graph(master: PrivateMaster) -> None:
    """Two faults can be caused at the same time in different namespaces."""
    client = MasterClient(master.uri)
    with caused("stale") as one, caused("returns_none") as other:
        assert one.namespace != other.namespace
        assert "Connection refused" in one.symptom().said
        assert "returned None" in other.symptom().said
    assert not [node for node in client.system_state().nodes if node.startswith("/lab")]
