"""Pays 200 times by the reference answer to 10.4, with a till in trouble every third time, and counts.

usage: ./course run python tests/bench/robust_client.py [--calls 200] [--seed N]

The till is a process of its own, which is stopped, killed and started again for real, and writes its books to
a file before it answers. A wrong answer is a receipt that is not in the books, a charge that is not there
once, a refusal that did not come out, or no receipt at all; a hang is a call not back 2 s after its deadline.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import signal
import sys
import tempfile
import threading
import time
import uuid
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import rospy
from course_pkg.srv import Charge, ChargeResponse

from course_pkg.errors import CallTimeout
from course_pkg.graph import Node, NodeProcess, join, prepare_node

SOLUTION = Path(__file__).parents[2] / "solutions" / "10_survive_trouble.ipynb"
DEADLINE = 15.0  # s for one payment: a till that is killed takes about one to be back
GRACE = 2.0  # s after the deadline
IN_THE_TILL = (
    "dies before it charges",
    "charges and dies",
    "is slow",
    "stumbles",
    "stumbles late",
    "refuses",
)
FROM_OUTSIDE = ("is frozen", "was killed", "is shut down", "is killed while it is asked")
FAULTS = (*IN_THE_TILL, *FROM_OUTSIDE)


def main() -> int:
    """Pay, and print wrong answers and hangs; both have to be 0."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calls", type=int, default=200)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    options = parser.parse_args()
    dice, found, times = random.Random(options.seed), Counter[str](), []  # noqa: S311 -- inputs, not secrets
    with tempfile.TemporaryDirectory(prefix="course-till-") as folder:
        node = join("bench")
        street = Street(Path(folder))
        pay = reference(node)
        for number in range(options.calls):
            fault = FAULTS[number // 3 % len(FAULTS)] if number % 3 == 0 else ""
            begun = time.monotonic()
            outcome = street.payment(pay, 1000 + number, fault, dice)
            times.append(time.monotonic() - begun)
            found[outcome] += 1
            found["faults"] += bool(fault)
            if outcome != "right":
                print(f"call {number}, a till that {fault or 'is well'}: {outcome}")
        street.close()
        node.leave()
    print(f"{options.calls} calls, {found['faults']} of them with a fault (seed {options.seed})")
    wrong = options.calls - found["right"] - found["hang"]
    print(f"wrong answers: {wrong}, hangs: {found['hang']}, longest call: {max(times):.1f} s")
    return int(bool(wrong or found["hang"]))


def reference(node: Node) -> Callable[[str, int, float], int | None]:
    """Return pay() as the solution of the chapter has it."""
    cells = json.loads(SOLUTION.read_text("utf-8"))["cells"]
    cell = next(cell for cell in cells if cell["metadata"].get("course", {}).get("exercise") == "10.4")
    names: dict[str, Any] = {
        "node": node,
        "rospy": rospy,
        "time": time,
        "uuid": uuid,
        "Charge": Charge,
        "CallTimeout": CallTimeout,
    }
    exec("".join(cell["source"]), names)  # noqa: S102 -- the course's own solution
    pay: Callable[[str, int, float], int | None] = names["pay"]
    return pay


class Street:
    """A till in a process of its own, which is started again whenever it has ended."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._over = threading.Event()
        self._till = self._started()
        self._till.wait_for_service("/till", timeout=20)
        self._keeper = threading.Thread(target=self._keep, daemon=True)
        self._keeper.start()

    def payment(self, pay: Callable[..., int | None], cents: int, fault: str, dice: random.Random) -> str:
        """Pay with a fault, and return "right", "hang", or what was wrong."""
        self._cause(fault, dice)
        results: list[object] = []

        def run() -> None:
            try:
                results.append(pay("/till", cents, DEADLINE))
            except Exception as error:  # noqa: BLE001 -- whatever came out is the outcome
                results.append(error)

        thread = threading.Thread(target=run, daemon=True)
        thread.start()
        thread.join(DEADLINE + GRACE)
        verdict = self._judged(results[0], cents, fault) if results else "hang"
        self._recover()
        return verdict

    def close(self) -> None:
        """End the till for good."""
        self._over.set()
        self._keeper.join(30)
        self._till.stop()

    def _cause(self, fault: str, dice: random.Random) -> None:
        (self._folder / "plan").write_text(fault if fault in IN_THE_TILL else "")
        if fault == "is frozen":
            os.kill(self._till.pid, signal.SIGSTOP)
            threading.Timer(dice.uniform(0.2, 2.0), self._signal, [self._till.pid, signal.SIGCONT]).start()
        elif fault == "was killed":
            os.kill(self._till.pid, signal.SIGKILL)
        elif fault == "is shut down":
            self._till.interrupt()
        elif fault == "is killed while it is asked":
            delay = dice.uniform(0.0, 0.004)  # a call takes about 3 ms
            threading.Timer(delay, self._signal, [self._till.pid, signal.SIGKILL]).start()

    def _signal(self, pid: int, number: int) -> None:
        if self._till.pid == pid and self._till.running:
            os.kill(pid, number)

    def _recover(self) -> None:
        """Wait until the till is well again, and has no plan any more."""
        (self._folder / "plan").write_text("")
        deadline = time.monotonic() + 30
        while time.monotonic() < deadline:
            try:
                self._till.wait_for_service("/till", timeout=20)
            except Exception:  # noqa: BLE001 -- it ended just now: the keeper starts another
                time.sleep(0.05)
            else:
                return

    def _judged(self, result: object, cents: int, fault: str) -> str:
        entries = [entry for entry in books(self._folder) if entry["cents"] == cents]
        if fault == "refuses":
            told = isinstance(result, rospy.ServiceException) and "no money" in str(result)
            return "right" if told and not entries else f"a refusal ended in {result!r}"
        if len(entries) != 1:
            return f"charged {len(entries)} times, and {result!r} was returned"
        receipt = entries[0]["receipt"]
        return "right" if result == receipt else f"{result!r} for the receipt {receipt}"

    def _keep(self) -> None:
        while not self._over.wait(0.1):
            if not self._till.running:
                self._till = self._started()

    def _started(self) -> NodeProcess:
        return NodeProcess([sys.executable, __file__, "--till", str(self._folder)])


def books(folder: Path) -> list[dict[str, Any]]:
    """Return what was charged; a line that was cut off by a kill is none."""
    path = folder / "books"
    lines = path.read_text("utf-8").splitlines() if path.exists() else []
    return [json.loads(line) for line in lines if line.endswith("}")]


class Till:
    """The till in its own process: each request once, written down before it is answered."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock = threading.Lock()
        self._receipts = {entry["id"]: entry["receipt"] for entry in books(folder)}

    def charge(self, request: Any) -> ChargeResponse:  # noqa: ANN401 -- a class that catkin generates
        """Charge, in whatever way the plan says."""
        with self._lock:
            plan = (self._folder / "plan").read_text("utf-8")
            (self._folder / "plan").write_text("")
        if plan == "refuses":
            raise rospy.ServiceException("no money on this card")
        if plan == "stumbles":
            raise ValueError("list index out of range")
        if plan == "dies before it charges":
            os._exit(1)
        if plan == "is slow":
            time.sleep(0.9)
        receipt = self._receipt(request)
        if plan == "charges and dies":
            os._exit(1)
        if plan == "stumbles late":
            raise ValueError("the printer has no paper")
        return ChargeResponse(receipt=receipt)  # type: ignore[no-untyped-call]

    def _receipt(self, request: Any) -> int:  # noqa: ANN401
        with self._lock:
            if request.request_id not in self._receipts:
                number = len(self._receipts) + 1
                entry = {"id": request.request_id, "receipt": number, "cents": request.cents}
                with (self._folder / "books").open("a", encoding="utf-8") as file:
                    file.write(json.dumps(entry) + "\n")
                self._receipts[request.request_id] = number
            return self._receipts[request.request_id]


def serve(folder: Path) -> None:
    """Be the till."""
    rospy.init_node("till")
    prepare_node()
    rospy.Service("/till", Charge, Till(folder).charge)
    rospy.spin()


if __name__ == "__main__":
    if sys.argv[1:2] == ["--till"]:
        serve(Path(sys.argv[2]))
    else:
        sys.exit(main())
