"""The git repository from which each student's server gets the released notebooks."""

from __future__ import annotations

import shutil
from pathlib import Path

from course_pkg.handout.edition.git import git, git_value
from course_pkg.setup.places import Places

BRANCH = "main"
PARTS = ("notebooks", "figures")
GIT_SETTINGS = "gitconfig"  # This file is in the folder that contains the repository.


def write_repository(places: Places, repository: Path) -> bool:
    """Commit the checkout's notebooks and figures to the repository; return whether the repository changed.

    Every user can read the repository. Raises HandoutError if git fails.
    """
    repository.mkdir(parents=True, exist_ok=True)
    for part in PARTS:
        shutil.rmtree(repository / part, ignore_errors=True)
        files = (path for path in (places.checkout / part).iterdir() if path.suffix in (".ipynb", ".svg"))
        (repository / part).mkdir()
        for path in files:
            shutil.copyfile(path, repository / part / path.name)
    if not (repository / ".git").exists():
        git(repository, "init", "-q", "-b", BRANCH)
    settings = f"[include]\n\tpath = /etc/gitconfig\n[safe]\n\tdirectory = {repository}\n"
    settings += f"\tdirectory = {repository}/.git\n"
    (repository.parent / GIT_SETTINGS).write_text(settings)
    git(repository, "add", "--all")
    changed = bool(git_value(repository, "status", "--porcelain"))
    if changed:
        git(repository, "commit", "-q", "-m", "Release notebooks", identity=True)
    return changed
