"""Selects the chapters of an edition: all chapters, the chapters of a path, or listed chapters."""

from __future__ import annotations

from collections.abc import Sequence

from course_pkg.checking.parts import chapters
from course_pkg.errors import HandoutError
from course_pkg.overview.reading import learning_paths


def chosen_chapters(path: str = "", listed: Sequence[str] = ()) -> tuple[str, ...]:
    """Return the chapters of the learning path `path`, the chapters in `listed`, or all chapters.

    The result is sorted, such as ("05", "06").

    For a learning path with two possible last chapters, the result contains both chapters. Raises
    HandoutError for an unknown path or chapter.
    """
    if path:
        return _of_path(path)
    known = chapters()
    unknown = sorted(set(listed) - set(known))
    if unknown:
        raise HandoutError(
            f"There is no chapter {', '.join(unknown)}. The chapters are {known[0]} to {known[-1]}. "
            "Write them with two digits and commas, such as --chapters 05,06."
        )
    return tuple(each for each in known if not listed or each in listed)


def _of_path(name: str) -> tuple[str, ...]:
    paths = learning_paths()
    found = {number for each in paths if _plain(each.name) == _plain(name) for number in each.chapters}
    if not found:
        names = dict.fromkeys(f'"{each.name}"' for each in paths)
        raise HandoutError(
            f'There is no path "{name}". Use one of these values for --path: {", ".join(names)}.'
        )
    return tuple(sorted(found))


def _plain(name: str) -> str:
    return " ".join(name.lower().replace("-", " ").replace("_", " ").split()).removeprefix("the ")
