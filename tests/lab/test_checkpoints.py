"""Checkpoints are kept in the cache."""

from __future__ import annotations

import asyncio
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace

import pytest
from tornado.web import HTTPError

from course_pkg.lab.checkpoints import CachedCheckpoints


@pytest.fixture
def kept(tmp_path: Path) -> CachedCheckpoints:
    """Checkpoints of a folder with two notebooks of one name."""
    for chapter in ("notebooks", "solutions"):
        folder = tmp_path / "checkout" / chapter
        folder.mkdir(parents=True)
        (folder / "05_x.ipynb").write_text(chapter)
    return CachedCheckpoints(root_dir=str(tmp_path / "checkout"), folder=str(tmp_path / "cache"))


def make(kept: CachedCheckpoints, path: str) -> None:
    """Make a checkpoint as the server does."""
    manager = SimpleNamespace(_get_os_path=lambda name: str(Path(kept.root_dir, name)))
    with ThreadPoolExecutor(1) as pool:
        pool.submit(asyncio.run, kept.create_checkpoint(manager, path)).result()


def test_two_of_one_name_do_not_meet(kept: CachedCheckpoints, tmp_path: Path) -> None:
    """A chapter and its solution have checkpoints of their own, and none is in the checkout."""
    before = sorted((tmp_path / "checkout").rglob("*"))
    for chapter in ("notebooks", "solutions"):
        make(kept, f"{chapter}/05_x.ipynb")
    for chapter in ("notebooks", "solutions"):
        assert Path(kept.checkpoint_path("checkpoint", f"/{chapter}/05_x.ipynb")).read_text() == chapter
    assert sorted((tmp_path / "checkout").rglob("*")) == before


def test_no_path_leads_out_of_the_checkout(kept: CachedCheckpoints) -> None:
    """What is no path within the checkout has no checkpoint."""
    with pytest.raises(HTTPError, match="404"):
        kept.checkpoint_path("checkpoint", "../elsewhere.ipynb")
