"""Reads the catkin packages that students submit, such as SUBMISSIONS/<student>/<package>/package.xml.

A package is a folder with a package.xml, at any depth below the student's folder. The folders that catkin
writes (build, devel, install) are left out. The name of a package is the name in its package.xml, as in ROS.
However, a part may need a package with the name of the folder, and no package with the name in package.xml.
Then the name of the folder is used.

Links and devices in a package are not read; a note in the grade reports them. A package that is too large is
not examined. If two packages have the same name, the newest package is used.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from course_pkg.checking.parts import Part, chapters, parts_of
from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.grade import Package, Submission
from course_pkg.grading.intake.archive import Entry
from course_pkg.grading.intake.naming import NOTEBOOK
from course_pkg.sandbox.job import work_file
from course_pkg.workspace.fault import manifest_tags

MANIFEST = "package.xml"
GENERATED = frozenset({"build", "devel", "install"})  # Catkin writes these folders.
# LARGEST is the maximum number of bytes of all files of a package; the course's own packages have less than
# 50 KiB.
LARGEST = 2 << 20
FILES = 300
SHOWN = 3  # SHOWN is the maximum number of names in a sentence.
NO_NOTEBOOK = "No notebook was handed in for this chapter."


@dataclass(frozen=True)
class Member:
    """A file, and its path below the student's folder."""

    entry: Entry
    path: tuple[str, ...]


@dataclass(frozen=True)
class Found:
    """A submitted package; `problem` says why it cannot be examined."""

    package: Package
    folder: str  # `folder` is the name of the package's folder.
    modified: float  # `modified` is the time of the newest file (s since 1970).
    notes: tuple[str, ...] = ()
    problem: str = ""

    def called(self, names: Sequence[str]) -> str:
        """Return the name of the package, the name of its folder, or "".

        `names` contains the names of the packages that parts need. The package's name has priority over the
        folder's name. If `names` contains no such name, return "".
        """
        return next((name for name in (self.package.name, self.folder) if name in names), "")


def package_roots(paths: Sequence[tuple[str, ...]]) -> set[tuple[str, ...]]:
    """Return the folders that are packages, from the paths of a student's files; packages are not nested."""
    with_manifest = {path[:-1] for path in paths if len(path) > 1 and path[-1] == MANIFEST}
    own = {root for root in with_manifest if not is_generated(root)}
    return {root for root in own if not any(root[:depth] in own for depth in range(1, len(root)))}


def is_generated(folders: Sequence[str]) -> bool:
    """Return whether the folders of a path include a folder that catkin generates, such as `build`."""
    return not GENERATED.isdisjoint(folders)


def root_of(path: tuple[str, ...], packages: set[tuple[str, ...]]) -> tuple[str, ...] | None:
    """Return the folder of the package that contains a file, or None if no package contains it."""
    if NOTEBOOK.fullmatch(path[-1]):
        return None
    return next((path[:depth] for depth in range(1, len(path)) if path[:depth] in packages), None)


def read_package(root: tuple[str, ...], members: Sequence[Member]) -> Found:
    """Read the files of one package, up to the limits on the number and size of files."""
    inside = "/".join(members[0].path[len(root) :])
    origin = clean.line(members[0].entry.path.removesuffix(f"/{inside}"), 500)
    found = Found(Package(root[-1], (), origin), root[-1], max(each.entry.modified for each in members))
    if len(members) > FILES:
        return replace(found, problem=_too_large(root[-1], f"it has more than {FILES} files"))
    contents, notes, left = [], [], LARGEST
    for member in members:
        name = "/".join(member.path[len(root) :])
        try:
            content = member.entry.read()
        except GradingError as error:
            notes.append(f"{clean.line(f'{root[-1]}/{name}', 120)} was not used: {error}.")
            continue
        left -= len(content)
        if left < 0:
            return replace(found, problem=_too_large(root[-1], f"it has more than {LARGEST >> 20} MiB"))
        contents.append((name, content, member.entry.executable))
    manifest = next((content for name, content, _ in contents if name == MANIFEST), None)
    if manifest is None:
        return replace(found, problem=f"The package {clean.line(root[-1], 60)} was not graded. {notes[0]}")
    # Many platforms do not store permissions. A student must make a program executable before it can run.
    # Therefore, if no file is executable, the platform has probably lost the permissions.
    lost = not any(executable for *_, executable in contents)
    files = [
        work_file(name, content, executable=executable or (lost and content.startswith(b"#!")))
        for name, content, executable in contents
    ]
    package = replace(found.package, name=_name(manifest) or root[-1], files=tuple(files))
    return replace(found, package=package, notes=tuple(notes))


def _too_large(name: str, why: str) -> str:
    return (
        f"The package {clean.line(name, 60)} was not graded: {why}. Remove the files that the build "
        "created, and remove recorded files such as .bag files."
    )


def _name(manifest: bytes) -> str:
    """Return the name of the package in the text of a package.xml, or ""."""
    tags = manifest_tags(manifest.decode("utf-8", "replace"))
    return next((tag.text for tag in tags if tag.name == "name"), "")


def attached(
    given: Sequence[Submission], packages: Mapping[str, Sequence[Found]], wanted: Sequence[str] = ()
) -> list[Submission]:
    """Add each student's packages to the submissions for chapters that need these packages.

    Return all submissions.

    `given` contains the submissions with notebooks, and `packages` contains the packages of each student.
    `wanted` contains the graded chapters; an empty list means all chapters. If a student has no notebook for
    a chapter, a package becomes a submission only if a part of the chapter needs one of its files.
    """
    if not packages:
        return list(given)
    asked = {chapter: _asked(parts_of(chapter)) for chapter in chapters()}
    submitted = {(each.student, each.chapter): each for each in given}
    for student, found in packages.items():
        for chapter in wanted or asked:
            made = _made(student, chapter, found, asked.get(chapter, {}), submitted.get((student, chapter)))
            if made is not None:
                submitted[student, chapter] = made
    known = {name for names in asked.values() for name in names}
    return [*submitted.values(), *_unknown(packages, known)]


def _asked(parts: Sequence[Part]) -> dict[str, set[str]]:
    """Return the files that the parts `parts` need; the keys are the names of packages."""
    asked: dict[str, set[str]] = {}
    for part in parts:
        for name, paths in part.package_files.items():
            asked.setdefault(name, set()).update(paths)
    return asked


def _made(
    student: str,
    chapter: str,
    found: Sequence[Found],
    asked: Mapping[str, set[str]],
    given: Submission | None,
) -> Submission | None:
    """Return the submission `given` with the packages that the chapter needs.

    If `given` is None, return a submission with only the packages, or None if the chapter needs no package.
    """
    taken, notes = [], []
    for name in asked:
        ranked = sorted((each for each in found if each.called(list(asked)) == name), key=_rank, reverse=True)
        if not ranked:
            continue
        best = ranked[0]
        if (
            best.problem
            or given is not None
            or asked[name].intersection(each.path for each in best.package.files)
        ):
            taken.append(replace(best, package=replace(best.package, name=name)))
            notes += [*best.notes, *filter(None, [best.problem])]
            notes += _about_names(name, ranked)
    if not taken:
        return given
    usable = tuple(each.package for each in taken if not each.problem)
    first = taken[0].package.origin
    base = given or Submission(student, chapter, b"", first, problem=NO_NOTEBOOK)
    return replace(base, packages=usable, notes=(*base.notes, *notes))


def _rank(found: Found) -> tuple[bool, float, str]:
    return not found.problem, found.modified, found.package.origin


def _about_names(name: str, ranked: Sequence[Found]) -> Iterator[str]:
    best, *others = ranked
    if best.package.name != name and not best.problem:
        other = clean.line(best.package.name, 60)
        yield (
            f"package.xml contains the package name {other}. The package was examined under the name of "
            f"its folder, {name}."
        )
    if others:
        shown = ", ".join(each.package.origin for each in others[:SHOWN])
        yield (
            f"{len(ranked)} packages are named {name}: {best.package.origin} was graded, and these "
            f"packages were not graded: {shown}."
        )


def _unknown(packages: Mapping[str, Sequence[Found]], known: set[str]) -> Iterator[Submission]:
    for student, found in packages.items():
        strange = [each for each in found if not each.called(sorted(known))]
        if strange:
            names = ", ".join(clean.line(each.package.name, 60) for each in strange[:SHOWN])
            problem = (
                f"These packages were not graded: {names}. The parts of the chapters need only these "
                "packages: "
            )
            problem += f"{', '.join(sorted(known))}."
            yield Submission(student, "", b"", strange[0].package.origin, problem=problem)
