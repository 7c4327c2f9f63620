"""15.6: the calls that the student's node must make, and the detector and the till that respond."""

from __future__ import annotations

import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from std_srvs.srv import TriggerRequest

from course_pkg.checking.peers.scripted_server import Act, HangUp, Late, Refuse
from course_pkg.checking.plain_values import Value
from course_pkg.srv import AwaitCustomerRequest

STANDING = 1.2  # The response to the first call is delayed by this time in s.


class Step(NamedTuple):
    """One call that the node must make: the required `patience`, the response, and the response's name."""

    waits: bool  # If `waits` is True, `patience` must be ~wait; otherwise, `patience` must be 0.
    act: Act
    name: str


def found(customer: bool) -> Mapping[str, Value]:
    """Return the fields of a response to detect_customer."""
    return {"found": customer}


REASON = "no message from the camera"
STEPS = (
    Step(True, Late(STANDING, found(False)), "False"),
    Step(True, found(True), "True"),
    Step(False, found(True), "True"),
    Step(False, Refuse(REASON), "an error"),
    Step(False, found(True), "True"),
    Step(False, found(False), "False"),
    Step(True, Refuse(REASON), "an error"),
    Step(True, HangUp(), "a closed connection"),
    Step(True, found(True), "True"),
    Step(False, found(False), "False"),
    Step(True, Late(0.3, found(False)), "False"),
)
# These calls of detect_customer end a visit; the first call has the number 1. After each of these calls, the
# node must call till/reset.
VISITS_END = [number for number, step in enumerate(STEPS, 1) if not step.waits and step.name == "False"]


def described(name: str) -> str:
    """Return a text for the result of a call; `name` is the name of a step."""
    return f"a response with found={name}" if name in ("True", "False") else name


class Alone:
    """A detector for a test in which no till is running.

    The detector reports a customer in the first call, and no customer in later calls.
    """

    def __init__(self) -> None:
        self.patiences: list[float] = []

    def answer(self, request: AwaitCustomerRequest) -> Act:
        """Return the response to this call."""
        self.patiences.append(request.patience)
        return found(True) if len(self.patiences) == 1 else Late(0.5, found(False))


@dataclass
class Call:
    """One call of the node: its `patience`, and the times of request and response (time.monotonic(), s)."""

    patience: float
    came: float
    answered: float


class Detector:
    """Responds to the calls according to `STEPS`, and records the calls."""

    def __init__(self, wait: float) -> None:
        self.wait = wait
        self.calls: list[Call] = []
        self._lock = threading.Lock()

    def answer(self, request: AwaitCustomerRequest) -> Act:
        """Record the call, and return the response or the failure."""
        with self._lock:
            step = STEPS[min(len(self.calls), len(STEPS) - 1)]
            now = time.monotonic()
            delay = step.act.delay if isinstance(step.act, Late) else 0.0
            self.calls.append(Call(round(request.patience, 3), now, now + delay))
            return step.act


class Till:
    """Refuses only its second call; for each call, stores how often the detector was called before."""

    def __init__(self, detector: Detector) -> None:
        self.resets: list[int] = []
        self._detector = detector

    def answer(self, _: TriggerRequest) -> Act:
        """Record the call, and return the response or the failure."""
        self.resets.append(len(self._detector.calls))
        second = len(self.resets) == 2
        return Refuse("no till today") if second else {"success": True, "message": "paid 5 cents"}
