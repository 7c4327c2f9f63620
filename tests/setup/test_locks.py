"""pyproject.toml, the lock files and environment.yml contain the same libraries."""

from __future__ import annotations

import ast
import re
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

from course_pkg.setup.libraries import lock_file
from course_pkg.setup.lock import LEFT_OUT, UV

ROOT = Path(__file__).parents[2]
DEPENDENCIES = "\ndependencies = ["
PIN = re.compile(r"^([a-z0-9-]+)==([^ ;]+)(?: ; (.*?))?(?: \\)?$", re.MULTILINE)
OLDEST = "< '3.11'"  # This marker selects Python 3.10, for which some libraries need older versions.


def pinned(extra: str) -> set[tuple[str, str]]:
    """Return the name and the version of each library in a lock file."""
    return {(name, version) for name, version, _ in PIN.findall(lock_file(extra).read_text())}


def declared(heading: str) -> list[tuple[str, str, str]]:
    """Return the name, version and marker of each library in a list of pyproject.toml.

    The function reads the file as text, because Python 3.10 has no TOML module.
    """
    text = (ROOT / "pyproject.toml").read_text()
    block = text[text.index(heading) :].split("\n]", 1)[0]
    return re.findall(r'"([a-z0-9-]+)==([^" ]+)(?: ; ([^"]*))?"', block)


@pytest.mark.parametrize(("extra", "heading"), [("course", DEPENDENCIES), ("test", "\ntest = [")])
def test_the_lock_is_made_from_pyproject(extra: str, heading: str) -> None:
    """The lock file contains each library of pyproject.toml with the same version."""
    wanted = {(name, version) for name, version, _ in declared(heading)}
    assert wanted
    assert wanted <= pinned(extra), "type: ./course lock"


def test_the_tests_use_the_libraries_of_students() -> None:
    """The lock file of the tests contains every library in the lock file of the course."""
    assert pinned("course") <= pinned("test")


@pytest.mark.parametrize("extra", ["course", "test", "uv"])
def test_every_file_has_a_hash_and_no_host(extra: str) -> None:
    """Each library in a lock file has hashes, and no lock file contains a registry's address."""
    text = lock_file(extra).read_text()
    assert "://" not in text
    pins = re.sub(r"^#.*\n", "", text, flags=re.MULTILINE)
    for block in re.split(r"\n(?=[a-z])", pins.strip()):
        assert "--hash=sha256:" in block, block.splitlines()[0]


def test_uv_is_the_version_that_the_code_names() -> None:
    """The lock file and `course lock` use the same version of uv."""
    assert pinned("uv") == {tuple(UV.split("=="))}


def test_conda_gets_the_same_libraries() -> None:
    """environment.yml and pyproject.toml contain the same libraries."""
    text = (ROOT / "environment.yml").read_text()
    pins = dict(re.findall(r"^  - ([a-z0-9_-]+)=([0-9][^\s]*)$", text, re.MULTILINE))
    for name in ("python", "ros-distro-mutex"):
        del pins[name]
    newest = {name: version for name, version, marker in declared(DEPENDENCIES) if OLDEST not in marker}
    assert {name.replace("_", "-"): version for name, version in pins.items()} == newest


@pytest.mark.parametrize("name", LEFT_OUT)
def test_excluded_libraries_are_in_no_lock(name: str) -> None:
    """No lock file pins an excluded library, but a comment in each lock file names the library."""
    for extra in ("course", "test"):
        assert name not in {pin for pin, _ in pinned(extra)}
        assert name in lock_file(extra).read_text().split("anyio==")[0]


def test_every_library_that_the_course_imports_is_declared() -> None:
    """pyproject.toml lists each locked library that course_pkg imports."""
    assert undeclared() == set()


def undeclared() -> set[str]:
    """Return the locked libraries that course_pkg imports, but pyproject.toml does not list."""
    locked = {name for name, _ in pinned("test")}
    modules = {
        name.partition(".")[0]
        for path in (ROOT / "course_pkg").rglob("*.py")
        if path.name not in ("answers.py", "fixtures.py")  # These files contain cells of notebooks.
        for node in ast.walk(ast.parse(path.read_bytes()))
        for name in imported(node)
    }
    distributions = packages_distributions()
    used = {name.lower().replace("_", "-") for module in modules for name in distributions.get(module, ())}
    named = {name for heading in (DEPENDENCIES, "\nhub = [", "\ntest = [") for name, *_ in declared(heading)}
    return (used & locked) - named


def imported(node: ast.AST) -> list[str]:
    """Return the full names of the modules in an import statement."""
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    return [node.module] if isinstance(node, ast.ImportFrom) and node.module and not node.level else []
