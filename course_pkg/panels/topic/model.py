"""What a topic panel knows, with no page, no kernel and no ROS: a station is told, and reports."""

from __future__ import annotations

import json
import re
import shlex
import threading
from collections.abc import Callable, Mapping
from dataclasses import asdict, replace
from typing import Any

from course_pkg.errors import CourseError, FieldError, NotATopic
from course_pkg.graph.station.paths import numbers
from course_pkg.interfaces import MessageType, message_type, publisher_lines, rostopic_line, schema
from course_pkg.panels.forms.form import MessageForm, State, correction
from course_pkg.panels.forms.texts import Texts
from course_pkg.panels.topic.echo import Echo
from course_pkg.panels.topic.settings import Settings
from course_pkg.panels.topic.words import ANY, mismatches, published

BURST = 1000  # messages
NAME = r"(/[A-Za-z]\w*)+"  # http://wiki.ros.org/Names
ACTIONS = ("publish", "burst", "repeat")


class TopicModel:
    """One topic: its type, the message as typed, how it is published, and what is heard. Raises NotATopic.

    `kind` is the type; None to take that of the topic as soon as somebody publishes it. `changed` hears of
    every change by keyword: `about`, `settings`, `draft`, `check`, `around`, `spoken`, `heard`, `echo`,
    `latest`, `curve`, `trouble`. `tell` tells the station, while there is one.
    """

    def __init__(
        self,
        topic: str,
        kind: MessageType | None,
        changed: Callable[..., None],
        tell: Callable[..., None],
        *,
        find_type: Callable[[str], MessageType] = message_type,
        turn: threading.RLock | None = None,
    ) -> None:
        if not re.fullmatch(NAME, topic, re.ASCII):
            raise NotATopic(
                f"{topic!r} cannot be the name of a topic. Give a full name such as /turtle1/cmd_vel: "
                "letters, digits and _, each part beginning with a letter."
            )
        self.topic = topic
        self.kind: MessageType | None = None
        self.settings = Settings()
        self.draft: Texts = {}
        self._form: MessageForm | None = None
        self._changed = changed
        self._tell = tell
        self._find_type = find_type
        self._turn = turn or threading.RLock()
        self._around: State = {}
        self._own = ""
        self._problem = ""
        self._refusals = 0
        self._heard: State = {"count": 0, "pace": {}}
        self._echo = Echo()
        if kind is not None:
            self._become(kind)
        else:
            self._changed(about=self._about(), settings=asdict(self.settings))

    def station_began(self) -> None:
        """Tell a new station what the one before knew."""
        with self._turn:
            self._own, self._echo, self._heard = "", Echo(), {"count": 0, "pace": {}}
            self.see({**self._around, "sources": []})
            self._changed(echo=[], latest=[], heard=self._heard, curve="", spoken={}, trouble="")
            self._tell_type()

    def report(self, parts: Mapping[str, Any]) -> None:
        """Take in what a station reports."""
        with self._turn:
            self._own = parts.get("node", self._own)
            if "around" in parts:
                self.see(parts["around"])
            shown: State = {}
            if "trouble" in parts:
                shown["trouble"] = parts["trouble"]
            if "spoken" in parts:
                spoken = parts["spoken"]
                shown["spoken"] = {**spoken, "words": published(spoken, self._own), "own": self._own}
            if "curve" in parts:
                shown["curve"] = json.dumps(parts["curve"])
            heard = {name: parts[name] for name in ("count", "pace") if name in parts}
            if heard:
                shown["heard"] = self._heard = {**self._heard, **heard}
            if "echo" in parts:
                if self.kind is None:
                    self._find(parts["echo"][-1]["type"])
                self._echo.take(parts["echo"], self.kind)
                shown |= {"echo": self._echo.entries, "latest": self._echo.latest}
            self._changed(**shown)

    def see(self, around: State) -> None:
        """Take in who is on the topic now."""
        with self._turn:
            self._around = around
            if self.kind is None:
                self._find(self._type_around())
            warnings = mismatches(self.kind, around, self._own, self._find_type) if self.kind else []
            self._changed(around={**around, "own": self._own, "warnings": warnings}, about=self._about())

    def edit(self, draft: Texts) -> None:
        """Take in what is typed now and say what it amounts to."""
        with self._turn:
            if self._form:
                self.draft = draft
                self._changed(check=self._checked())

    def set(self, settings: Settings) -> None:
        """Take in how one wants to publish, and which number is to be drawn."""
        with self._turn:
            before, self.settings = self.settings, settings
            if settings.path != before.path:
                self._changed(curve="")
                self._tell("plot", path=settings.path)
            self._changed(check=self._checked())

    def act(self, action: str, draft: Texts, settings: Settings) -> None:
        """Publish once, in a burst, or again and again, unless something typed is not right."""
        with self._turn:
            if not self._form or action not in ACTIONS:
                return
            self.draft = draft
            self.set(settings)
            errors = self._checked()["errors"]
            needless = "@rate" if action != "repeat" else ""
            if {field for field in errors if field != needless}:
                self._refuse()
                return
            how: State = {"texts": self.draft, "latch": settings.latch, "queue": settings.size}
            if action == "repeat":
                self._tell("repeat", **how, rate=settings.hertz)
            else:
                self._tell("publish", **how, count=BURST if action == "burst" else 1)

    def stop(self) -> None:
        """Publish at no rate any more."""
        self._tell("stop")

    def withdraw(self) -> None:
        """End the publisher."""
        self._tell("withdraw")

    def _refuse(self) -> None:
        self._refusals += 1
        self._changed(check=self._checked())

    def _checked(self) -> State:
        """Return what is wrong, or the commands that do the same by hand."""
        if not self._form:
            return {"errors": {}, "refused": self._refusals}
        check = self._form.checked(self.draft)
        wrong: dict[str, str] = {}
        for read in ("hertz", "size"):
            try:
                getattr(self.settings, read)
            except FieldError as error:
                wrong[error.field] = correction(error)
        return {**check, "errors": {**check["errors"], **wrong}, "refused": self._refusals}

    def _commands(self, values: Mapping[str, Any]) -> dict[str, str]:
        """Return the lines that publish these values once and again and again; with what is not wrong."""
        assert self.kind is not None
        settings = self.settings
        try:
            rate, queue = settings.hertz, settings.size
        except FieldError:
            return {}
        latch = settings.latch
        return {
            "once": rostopic_line(self.topic, self.kind, values, latch=latch),
            "often": rostopic_line(self.topic, self.kind, values, rate=rate, latch=latch),
            "python": publisher_lines(self.topic, self.kind, values, latch=latch, queue_size=queue),
        }

    def _type_around(self) -> str:
        """Return the type that a publisher has, or else that which the master knows."""
        types = [each["type"] for each in self._around.get("publishers", ())]
        return next((each for each in (*types, self._around.get("type", "")) if each and each != ANY), "")

    def _find(self, name: str) -> None:
        self._problem = ""
        if name:
            try:
                self._become(self._find_type(name))
            except CourseError as error:
                self._problem = str(error)

    def _become(self, kind: MessageType) -> None:
        self.kind = kind
        self._form = MessageForm(kind, self._commands)
        self.draft = self._form.blank
        paths = numbers(kind)
        self.settings = replace(self.settings, path=paths[0] if paths else "")
        self._changed(
            about=self._about(), draft=self.draft, check=self._checked(), settings=asdict(self.settings)
        )
        self._tell_type()

    def _tell_type(self) -> None:
        if self.kind is not None:
            self._tell("type", name=self.kind.name, text="" if self.kind.built else self.kind.text)
            self._tell("plot", path=self.settings.path)

    def _about(self) -> State:
        listen = [f"rostopic {verb} {shlex.quote(self.topic)}" for verb in ("echo", "hz", "info")]
        about: State = {"topic": self.topic, "problem": self._problem, "burst": BURST, "listen": listen}
        if self.kind is None:
            nobody = (
                f"Nobody publishes {self.topic} yet, so its type is not known. Start a publisher, or give "
                f"the type: TopicPanel({self.topic!r}, 'std_msgs/Float64')."
            )
            return about | {"problem": self._problem or nobody}
        return about | {"message": schema(self.kind), "numbers": numbers(self.kind)}
