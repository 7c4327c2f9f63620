"""A pytest plug-in that selects tests.

The option `--changed` selects tests that a change can affect, and `--slow` selects slow tests.

A test in tests/NAME depends on this folder, on the package course_pkg/NAME, and on all packages that
course_pkg/NAME may import. The import-linter contract in pyproject.toml lists these packages. A test of a
chapter depends on the chapter's folder and on the chapters that the chapter imports.

A group contains the tests of one file. If a file contains tests of several chapters, the tests of each
chapter form a group. With `--changed`, a group runs only if a file on which its tests depend has changed
since the group passed.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

import pytest

from course_pkg.authoring.suite import repeat_command
from course_pkg.checking.parts import chapters, folders_for
from course_pkg.files import write_atomically
from course_pkg.setup import CATKIN_FOLDERS, Places
from course_pkg.setup.stamps import digest

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[1]
ALWAYS = ("pyproject.toml", "CMakeLists.txt", "package.xml", "course_pkg/setup/locks/test.txt")
# The pattern finds the chapter's number in the id of a test, such as "[05.1 right: …]".
CHAPTER = re.compile(r"\[(\d\d)[._]")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options `--changed` and `--slow`."""
    group = parser.getgroup("course")
    group.addoption("--changed", action="store_true", help="run only the tests that a change can affect")
    group.addoption("--slow", action="store_true", help="run only the slow tests")


class Selection:
    """Stores, for each group of tests that passed, the digest of the group's files."""

    def __init__(self, file: Path) -> None:
        self._file = file
        self._passed: dict[str, str] = json.loads(file.read_text()) if file.exists() else {}
        self._outcomes: dict[str, bool] = {}
        self._selected: dict[str, int] = {}

    def is_unchanged(self, item: pytest.Item) -> bool:
        """Return whether the test's group passed, and its files have not changed since the last pass."""
        return self._passed.get(group_of(item.nodeid)) == digest_of(group_of(item.nodeid))

    def has_changed(self, item: pytest.Item) -> bool:
        """Return whether the test's group passed, but its files have changed since the last pass."""
        return group_of(item.nodeid) in self._passed and not self.is_unchanged(item)

    def note(self, report: pytest.TestReport) -> None:
        """Record whether a phase of a test (set-up, call, tear-down) has failed."""
        group = group_of(report.nodeid)
        self._outcomes[group] = self._outcomes.get(group, True) and not report.failed

    def store(self) -> None:
        """Store the groups that passed, and remove the groups that failed."""
        for group, passed in self._outcomes.items():
            self._passed.pop(group, None)
            if passed:
                self._passed[group] = digest_of(group)
        write_atomically(self._file, json.dumps(self._passed, indent=1, sort_keys=True))


class SelectionPlugin:
    """The pytest hooks of the plug-in."""

    def __init__(self, config: pytest.Config) -> None:
        self._config = config
        self._selection = Selection(Places.of().cache / "tests.json")
        self._whole = not config.option.keyword and not any("::" in word for word in config.args)

    def pytest_collection_modifyitems(self, config: pytest.Config, items: list[pytest.Item]) -> None:
        """Without `--slow`, deselect the slow tests; with `--slow`, deselect all other tests.

        With `--changed`, also deselect the tests of unchanged groups.
        """
        named = any("::" in word for word in config.args)
        left = {
            item
            for item in items
            if (not named and not self._is_wanted(item, slow=config.getoption("--slow")))
            or (config.getoption("--changed") and self._selection.is_unchanged(item))
        }
        config.hook.pytest_deselected(items=list(left))
        items[:] = [item for item in items if item not in left]

    def _is_wanted(self, item: pytest.Item, *, slow: bool) -> bool:
        """Return whether the usual test run includes a test.

        If `slow` is true, return whether the run of slow tests includes the test.
        """
        if item.get_closest_marker("when_changed"):
            return slow or self._selection.has_changed(item)
        return (item.get_closest_marker("slow") is not None) == slow

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Record each outcome, and print a failure immediately."""
        self._selection.note(report)
        if report.failed and not hasattr(self._config, "workerinput"):
            reporter = self._config.pluginmanager.get_plugin("terminalreporter")
            reporter.write_line(f"\n{report.nodeid} failed ({report.when})")

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Store the passed groups after a complete run."""
        controller = not hasattr(session.config, "workerinput")
        if controller and self._whole and not session.shouldstop and not session.config.option.markexpr:
            self._selection.store()

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Print, for each failed test, the command that runs this test again."""
        failed = [*terminalreporter.getreports("failed"), *terminalreporter.getreports("error")]
        names = dict.fromkeys(report.nodeid.split("@")[0] for report in failed)
        if names:
            terminalreporter.section("run the failures again")
            for name in names:
                terminalreporter.line(repeat_command(name))


def pytest_configure(config: pytest.Config) -> None:
    """Register the hooks that need the configuration."""
    config.pluginmanager.register(SelectionPlugin(config), "course-selection")


def group_of(test: str) -> str:
    """Return the group of a test: the file of the test, and the chapter in the id of the test."""
    found = CHAPTER.search(test)
    return f"{test.partition('::')[0]} {found[1] if found else ''}".strip()


@cache
def digest_of(group: str) -> str:
    """Return the digest of all files on which a group depends."""
    file, _, chapter = group.partition(" ")
    folder = Path(file).parts[1] if len(Path(file).parts) > 2 else ""
    packages = _packages_below(folder)
    parts = [_digest_of_folder("tests", own=True), _digest_of_folder(f"tests/{folder}")]
    parts += [_digest_of_files(ALWAYS), *(_digest_of_folder(name) for name in CATKIN_FOLDERS)]
    parts += [_digest_of_folder(f"course_pkg/{name}") for name in packages if name != "chapters"]
    if "chapters" in packages or chapter:
        parts += [_digest_of_folder(path) for path in chapter_paths(chapter)]
    return digest(parts)


def _packages_below(folder: str) -> list[str]:
    """Return the packages on which a folder of tests depends.

    The package with the same name as the folder belongs to an import layer. The result contains all packages
    of this layer and of all lower layers.

    If no package has the name of the folder, return all packages.
    """
    package = {"chapters": "authoring", "notebooks": "authoring"}.get(folder, folder)
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]
    names = (layer.split("|") for layer in settings["contracts"][0]["layers"])
    layers = [[name.strip() for name in layer] for layer in names]
    first = next((number for number, layer in enumerate(layers) if package in layer), 0)
    return [name for layer in layers[first:] for name in layer]


def chapter_paths(chapter: str) -> Iterator[str]:
    """Yield the paths on which the tests of a chapter depend; an empty string means all chapters."""
    for number in [chapter] if chapter else chapters():
        yield from (str(folder.relative_to(ROOT)) for folder in folders_for(number))
    for pattern in (f"solutions/{chapter}*", f"notebooks/{chapter}*"):
        yield from sorted(str(path.relative_to(ROOT)) for path in ROOT.glob(pattern))


@cache
def _digest_of_folder(path: str, *, own: bool = False) -> str:
    """Return the digest of a file, of a module or of a folder.

    If `own` is true, ignore the subfolders of the folder.
    """
    where = ROOT / path
    found = where.glob("*" if own else "**/*") if where.is_dir() else [where, where.with_suffix(".py")]
    return _digest_of_files(sorted(str(file.relative_to(ROOT)) for file in found if _counts(file)))


def _digest_of_files(names: Iterable[str]) -> str:
    return digest(part for name in names for part in (name, (ROOT / name).read_bytes()))


def _counts(file: Path) -> bool:
    return file.is_file() and "__pycache__" not in file.parts and file.suffix != ".pyc"
