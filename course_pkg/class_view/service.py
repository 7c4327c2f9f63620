"""The running service: the results, their model, and the teachers and students who may use the service."""

from __future__ import annotations

import asyncio
import sqlite3
import time
from collections.abc import Mapping
from dataclasses import dataclass

from course_pkg.class_view.identity import Identity
from course_pkg.class_view.model import ClassModel
from course_pkg.class_view.results import received
from course_pkg.class_view.storage import DAY, Storage
from course_pkg.types.fields import Plain

# Every `LOOK` s, the service tests whether `course class --delete` has changed the database.
LOOK = 0.5
CLEANING = 3600.0  # This is the time in s between two deletions of old results.
GATHER = 0.1  # Results that arrive within this time in s are sent to the page together.


@dataclass(frozen=True)
class Settings:
    """The settings that a teacher has chosen."""

    teacher: str  # the name that students see
    days: float  # the number of days after a student's last result, before the student's results are deleted
    names: Mapping[str, str]  # a dict from usernames to students' names


class ClassService:
    """Stores results, and notifies open pages of new results."""

    def __init__(self, storage: Storage, identity: Identity, settings: Settings) -> None:
        self.identity, self.settings = identity, settings
        self._storage = storage
        self._cleaned = time.monotonic()
        self._changed = asyncio.Condition()
        storage.delete_old(settings.days)
        self._seen = storage.changes_by_others()
        self.model = ClassModel(settings.names, storage.read())

    async def store(self, student: str, data: object) -> list[str]:
        """Store the results in `data`; return the ids of the results that need not be sent again.

        Raises ValueError, TooMany, or sqlite3.Error if the results cannot be stored.
        """
        now = time.time()
        results, ids = received(student, data, now, now - self.settings.days * DAY)
        self.model.add(self._storage.add(results))
        await self._tell()
        return ids

    async def changes(self, epoch: str, since: int, timeout: float) -> dict[str, Plain]:
        """Wait for a change since the version `since`, for at most `timeout` s, and return the changes."""
        async with self._changed:
            try:
                await asyncio.wait_for(self._changed.wait_for(lambda: self._is_new(epoch, since)), timeout)
            except asyncio.TimeoutError:
                return self.model.changes(epoch, since)
        await asyncio.sleep(GATHER)
        return self.model.changes(epoch, since)

    async def watch(self) -> None:
        """Delete old results, and read the database again when another process has changed it."""
        while True:
            await asyncio.sleep(LOOK)
            try:
                await self._refresh()
            except sqlite3.Error:
                continue  # the database is busy, or the disk is full; the loop tries again after `LOOK` s

    async def _refresh(self) -> None:
        deleted = 0
        if time.monotonic() - self._cleaned > CLEANING:
            deleted = self._storage.delete_old(self.settings.days)
            self._cleaned = time.monotonic()
        seen = self._storage.changes_by_others()
        if deleted or seen != self._seen:
            self._seen = seen
            self.model = ClassModel(self.settings.names, self._storage.read())
            await self._tell()

    def _is_new(self, epoch: str, since: int) -> bool:
        return epoch != self.model.epoch or since < self.model.version

    async def _tell(self) -> None:
        async with self._changed:
            self._changed.notify_all()
