"""Run the steps of the set-up that are not finished; independent steps run at the same time."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from course_pkg.errors import SetupError
from course_pkg.setup import catkin_workspace, libraries, packages
from course_pkg.setup.journal import Journal
from course_pkg.setup.places import Places
from course_pkg.setup.progress import Progress
from course_pkg.setup.stamps import Stamps, digest, locked

# Each key is the name of a lock file. The value is a part of the title of the step that installs the
# libraries.
EXTRAS = {"course": "", "hub": " of the hub", "test": " of the tests"}


class Step(NamedTuple):
    """One step of the set-up.

    The function `is_done` must be fast, because it runs at every start of `course`. `makes` is the folder
    that the step creates.
    """

    title: str
    is_done: Callable[[], bool]
    make: Callable[[Journal, Progress], None]
    makes: Path | None = None


def ensure(places: Places, *, grade: bool = False, hub: bool = False, test: bool = False) -> None:
    """Set up what is missing.

    If nothing is missing, this function takes a few milliseconds and prints nothing. In a shared
    installation, only the libraries of the hub may be missing. They are installed when an administrator runs
    `course hub` for the first time. Raises SetupError if a step fails; the error message contains the next
    step for the user.
    """
    stages = steps_of(places, grade=grade, hub=hub, test=test)
    if _finished(stages):
        return
    if places.installed and hub and os.access(places.cache, os.W_OK):
        os.umask(0o022)  # The students' servers have to be able to read the libraries of the hub.
    elif places.installed and hub and _finished(steps_of(places)):
        raise SetupError(
            f"The installation in {places.checkout.parent} does not contain the libraries of the hub yet. "
            "They are installed when an administrator runs `course hub` for the first time."
        )
    elif places.installed:
        raise SetupError(
            f"The installation in {places.checkout.parent} does not work on this machine any "
            "more, for example because Python or ROS was updated. As an administrator, type\n  "
            "course install\nagain."
        )
    places.make_cache()
    progress = Progress()
    waiting = "Another set-up of this checkout is running. This set-up waits until the other set-up ends."
    try:
        with locked(places.cache / "lock", lambda: progress.note(waiting)) as lock:
            journal = Journal(places.logs, lock)
            for stage in stages:
                _run_stage([step for step in stage if not step.is_done()], journal, progress)
    except OSError as error:
        raise _explained(error, places) from error
    except KeyboardInterrupt:
        progress.note("The set-up was interrupted. The next set-up continues with the unfinished steps.")
        raise


def _finished(stages: Sequence[Sequence[Step]]) -> bool:
    return all(step.is_done() for stage in stages for step in stage)


def steps_of(
    places: Places, *, grade: bool = False, hub: bool = False, test: bool = False
) -> list[list[Step]]:
    """Return lists of steps; the lists run in order, and the steps of one list can run at the same time."""
    stamps = Stamps(places.stamps)
    library_step = _library_step(places, stamps, "test" if test else "hub" if hub else "course")
    catkin = _workspace_step(places, stamps)
    if places.conda:  # For conda, environment.yml lists the packages and the libraries.
        return [[catkin]]
    platform = packages.read_platform(places.checkout)
    wanted = [*platform.course, *(platform.test if test else platform.grade if grade else ())]
    return [
        [_bootstrap_step(platform.bootstrap, library_step)],
        [_package_step(f"ROS and tools from {platform.name}", wanted, stamps), library_step],
        [catkin],
    ]


def _bootstrap_step(wanted: Sequence[str], libraries: Step) -> Step:
    def is_done() -> bool:
        return libraries.is_done() or not packages.missing_packages(wanted)

    def make(journal: Journal, progress: Progress) -> None:
        packages.install_packages(wanted, journal, progress.note)

    return Step("pip", is_done, make)


def _package_step(title: str, wanted: Sequence[str], stamps: Stamps) -> Step:
    name = f"packages-{digest(wanted)}"

    def is_done() -> bool:
        state = packages.database_state()
        if stamps.read(name) == state:
            return True
        if packages.missing_packages(wanted):
            return False
        # The stamp is written here; the next start of `course` then does not have to call dpkg.
        with suppress(OSError):
            stamps.write(name, state)
        return True

    def make(journal: Journal, progress: Progress) -> None:
        packages.install_packages(packages.missing_packages(wanted), journal, progress.note)

    return Step(title, is_done, make)


def _library_step(places: Places, stamps: Stamps, extra: str) -> Step:
    def is_done() -> bool:
        # Each lock file contains all libraries of the earlier lock files. Therefore, the stamp of a later
        # lock file is sufficient.
        sufficient = list(EXTRAS)[list(EXTRAS).index(extra) :]
        made = (stamps.read(f"python-{name}") == libraries.libraries_key(name) for name in sufficient)
        return libraries.environment_works(places) and any(made)

    def make(journal: Journal, _progress: Progress) -> None:
        stamps.clear(f"python-{extra}")
        libraries.make_environment(places, extra, journal)
        stamps.write(f"python-{extra}", libraries.libraries_key(extra))

    return Step(f"Python libraries{EXTRAS[extra]}", is_done, make, places.venv)


def _workspace_step(places: Places, stamps: Stamps) -> Step:
    def is_done() -> bool:
        unchanged = stamps.read("workspace") == catkin_workspace.workspace_key(places)
        return unchanged and catkin_workspace.workspace_intact(places)

    def make(journal: Journal, _progress: Progress) -> None:
        stamps.clear("workspace")
        catkin_workspace.build_workspace(places, journal)
        stamps.write("workspace", catkin_workspace.workspace_key(places))

    return Step("catkin workspace", is_done, make, places.workspace)


def _run_stage(steps: Sequence[Step], journal: Journal, progress: Progress) -> None:
    def run(step: Step) -> None:
        with progress.step(step.title):
            step.make(journal, progress)

    # The import takes 5 ms, and is not needed if all steps are finished.
    from concurrent.futures import ThreadPoolExecutor

    with progress.painting(), ThreadPoolExecutor(max_workers=2) as pool:
        for finished in [pool.submit(run, step) for step in steps]:
            finished.result()


def _explained(error: OSError, places: Places) -> SetupError:
    if error.errno == errno.ENOSPC:
        return SetupError(
            f"The disk of {places.cache} is full. Delete files that you do not need, and start again."
        )
    return SetupError(f"The set-up stopped: {error}. Correct the cause, and start again.")
