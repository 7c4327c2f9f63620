"""The state of a topic panel; this module does not need ROS.

The publisher and the subscriber run in a separate process, the topic process. The panel sends commands to
this process and receives its reports.
"""

from __future__ import annotations

import json
import re
import shlex
import threading
from collections.abc import Callable
from dataclasses import asdict, replace
from typing import TypedDict

from course_pkg.errors import CourseError, FieldError, NotATopic
from course_pkg.panels.forms.form import Check, Draft, MessageForm, Values, correction
from course_pkg.panels.topic.reports import (
    FindType,
    MessageLog,
    PublisherState,
    SubscriptionState,
    mismatches,
    published,
)
from course_pkg.panels.topic.settings import RATE, Settings
from course_pkg.ros.topic.connections import ANY
from course_pkg.ros.topic.field_paths import measurement, numbers
from course_pkg.ros.topic.reports import Connections, Report
from course_pkg.types import MessageSchema, MessageType, message_type, publisher_lines, rostopic_line, schema

BURST = 1000  # A burst contains this many messages.
NAME = r"(/[A-Za-z]\w*)+"  # http://wiki.ros.org/Names
ACTIONS = ("publish", "burst", "repeat")


class About(TypedDict, total=False):
    """The topic, and the fields of its type; the page can plot the numeric fields.

    `problem` is the reason why there is no form, or "" if there is a form.
    """

    topic: str
    problem: str
    burst: int
    listen: list[str]
    message: MessageSchema
    numbers: list[str]


class TopicModel:
    """One topic: its type, the message in the form, the publisher's settings, and the received messages.

    `kind` is the type of the messages. If `kind` is None, the panel uses the type of the first publisher.
    After each change, the model calls the function `changed` with some of the keyword arguments `about`,
    `settings`, `draft`, `check`, `connections`, `publisher`, `subscription`, `messages`, `latest`, `curve`
    and `trouble`. The function `command` sends a command to the topic process, if the process is running.
    Raises NotATopic if `topic` is not a valid name.
    """

    def __init__(
        self,
        topic: str,
        kind: MessageType | None,
        changed: Callable[..., None],
        command: Callable[..., None],
        *,
        find_type: FindType = message_type,
        turn: threading.RLock | None = None,
    ) -> None:
        if not re.fullmatch(NAME, topic, re.ASCII):
            raise NotATopic(
                f"{topic!r} cannot be the name of a topic. Use a full name such as "
                "/turtle1/cmd_vel, with letters, digits and _. Each part has to begin with a "
                "letter."
            )
        self.topic = topic
        self.kind: MessageType | None = None
        self.settings = Settings()
        self.draft: Draft = {}
        self._form: MessageForm | None = None
        self._changed = changed
        self._command = command
        self._find_type = find_type
        self._turn = turn or threading.RLock()
        self._connections: Connections = {}
        self._own = ""
        self._problem = ""
        self._refusals = 0
        self._subscription: SubscriptionState = {"count": 0, "statistics": {}}
        self._log = MessageLog()
        if kind is not None:
            self._become(kind)
        else:
            self._changed(about=self._about(), settings=asdict(self.settings))

    def process_began(self) -> None:
        """Send the type and the plotted field to a new topic process."""
        with self._turn:
            self._own, self._log, self._subscription = "", MessageLog(), {"count": 0, "statistics": {}}
            self.see({**self._connections, "sources": []})
            empty = {"messages": [], "latest": [], "curve": "", "publisher": {}, "trouble": ""}
            self._changed(subscription=self._subscription, **empty)
            self._send_type()

    def report(self, report: Report) -> None:
        """Store a report that the topic process has sent."""
        with self._turn:
            self._own = report.get("node", self._own)
            if "connections" in report:
                self.see(report["connections"])
            if "trouble" in report:
                self._changed(trouble=report["trouble"])
            if "publisher" in report:
                about = report["publisher"]
                publisher: PublisherState = {**about, "words": published(about, self._own), "own": self._own}
                self._changed(publisher=publisher)
            if "curve" in report:
                self._changed(curve=json.dumps(report["curve"]))
            if "count" in report or "statistics" in report:
                before = self._subscription
                self._subscription = {
                    "count": report.get("count", before["count"]),
                    "statistics": report.get("statistics", before["statistics"]),
                }
                self._changed(subscription=self._subscription)
            if "messages" in report:
                if self.kind is None:
                    self._find(report["messages"][-1]["type"])
                self._log.add(report["messages"], self.kind)
                self._changed(messages=self._log.entries, latest=self._log.latest)

    def see(self, connections: Connections) -> None:
        """Store the current publishers and subscribers of the topic."""
        with self._turn:
            self._connections = connections
            if self.kind is None:
                self._find(self._type_on_the_graph())
            warnings = mismatches(self.kind, connections, self._own, self._find_type) if self.kind else []
            seen = {**connections, "own": self._own, "warnings": warnings}
            self._changed(connections=seen, about=self._about())

    def edit(self, draft: Draft) -> None:
        """Store the texts of the form; report their errors, or the commands that publish this message."""
        with self._turn:
            if self._form:
                self.draft = draft
                self._changed(check=self._checked())

    def set(self, settings: Settings) -> None:
        """Store the publisher's settings and the field to plot."""
        with self._turn:
            before, self.settings = self.settings, settings
            if settings.path != before.path:
                self._changed(curve="")
                self._command("plot", path=settings.path)
            self._changed(check=self._checked())

    def act(self, action: str, draft: Draft, settings: Settings) -> None:
        """Publish the message in the form once, in a burst, or at a rate.

        Do nothing if the form has an error.
        """
        with self._turn:
            if not self._form or action not in ACTIONS:
                return
            self.draft = draft
            self.set(settings)
            errors = self._checked()["errors"]
            unused = RATE if action != "repeat" else ""
            if {field for field in errors if field != unused}:
                self._refusals += 1
                self._changed(check=self._checked())
                return
            about = {"texts": self.draft, "latch": settings.latch, "queue": settings.size}
            if action == "repeat":
                self._command("repeat", **about, rate=settings.hertz)
            else:
                self._command("publish", **about, count=BURST if action == "burst" else 1)

    def stop(self) -> None:
        """Stop publishing at a rate."""
        self._command("stop")

    def withdraw(self) -> None:
        """Unregister the publisher."""
        self._command("withdraw")

    def _checked(self) -> Check:
        """Return the errors of the form, or the commands that publish this message."""
        if not self._form:
            return {"errors": {}, "refused": self._refusals}
        check = self._form.checked(self.draft)
        wrong: dict[str, str] = {}
        for setting in ("hertz", "size"):
            try:
                getattr(self.settings, setting)
            except FieldError as error:
                wrong[error.field] = correction(error)
        return {**check, "errors": {**check["errors"], **wrong}, "refused": self._refusals}

    def _commands(self, values: Values) -> Check:
        """Return the commands for publishing these values once and at a rate, or {} if a setting is wrong."""
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

    def _type_on_the_graph(self) -> str:
        """Return the name of the type that a publisher uses.

        Without a publisher, return the name of the type that the master stores.
        """
        types = [each["type"] for each in self._connections.get("publishers", ())]
        known = (*types, self._connections.get("type", ""))
        return next((each for each in known if each and each != ANY), "")

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
        self.settings = replace(self.settings, path=measurement(kind))
        self._changed(
            about=self._about(), draft=self.draft, check=self._checked(), settings=asdict(self.settings)
        )
        self._send_type()

    def _send_type(self) -> None:
        if self.kind is not None:
            self._command("type", name=self.kind.name, text="" if self.kind.built else self.kind.text)
            self._command("plot", path=self.settings.path)

    def _about(self) -> About:
        listen = [f"rostopic {verb} {shlex.quote(self.topic)}" for verb in ("echo", "hz", "info")]
        about: About = {"topic": self.topic, "problem": self._problem, "burst": BURST, "listen": listen}
        if self.kind is None:
            unknown = (
                f"No node publishes {self.topic} yet, so its type is not known. Start a "
                f"publisher, or pass the type: TopicPanel({self.topic!r}, 'std_msgs/Float64')."
            )
            return {**about, "problem": self._problem or unknown}
        return {**about, "message": schema(self.kind), "numbers": numbers(self.kind)}
