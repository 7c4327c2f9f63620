"""Collecting what the nodes on the graph have recorded, in bounded time."""

from __future__ import annotations

import json
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from course_pkg.errors import GraphError
from course_pkg.graph.events import MASTER, PUBLISH
from course_pkg.graph.farewell import farewells
from course_pkg.graph.matching import Record, matched
from course_pkg.graph.probe import Probe, Reach, ask_all, rpc_answer, rpc_probe
from course_pkg.graph.recording import Recording
from course_pkg.graph.rpc import MasterClient
from course_pkg.graph.slave import RECORD
from course_pkg.graph.trace import recorder

PATIENCE = 1.0  # s for all nodes together; 20,000 marks take 0.3 s
LEFT_OUT = ("/rosout",)  # it takes part in what is left out only
REASONS = {
    Reach.REFUSED: "its process is gone",
    Reach.SILENT: f"it did not answer within {PATIENCE:g} s: it is stopped, or busy",
    Reach.LOST: "it could not be reached, or hung up",
    Reach.ANSWERED: "it keeps no record: it is not one of the course's Python nodes",
}
ELSEWHERE = "it goes by another clock, on another machine"
ENDED = "it was gone when the recording ended, and its record with it"


@dataclass
class _Gathered:
    records: list[tuple[str, dict[str, Any]]] = field(default_factory=list)
    unrecorded: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


@contextmanager
def recorded(node: str, uri: str, master: MasterClient) -> Iterator[Recording]:
    """Record the block from the kernel's `node` at `uri`; the recording is filled when the block ends."""
    recording = Recording(node=node)
    with farewells(node, uri, master):
        start = time.monotonic()
        try:
            yield recording
        finally:
            end = time.monotonic()
            _fill(recording, _gathered(node, master, start), start, end)


def _gathered(node: str, master: MasterClient, since: float) -> _Gathered:
    own = recorder()
    gathered = _Gathered(
        [(node, own.since(since)), *(left for left in list(own.left) if _since(left[1], since))]
    )
    try:
        uris = master.lookup_all(master.system_state().nodes, ())[0]
    except GraphError as error:
        gathered.notes.append(f"The other nodes are not known, since the master did not tell. {error}")
        return gathered
    others = {name: uri for name, uri in uris.items() if name != node and name not in LEFT_OUT}
    probes = {name: rpc_probe(uri, RECORD, since) for name, uri in others.items()}
    asked = time.monotonic()
    ask_all(list(probes.values()), PATIENCE)
    answered = time.monotonic()
    for name, probe in probes.items():
        _take(gathered, name, probe, asked, answered)
    return gathered


def _take(gathered: _Gathered, name: str, probe: Probe, asked: float, answered: float) -> None:
    record = _told(probe)
    if record is None:
        gathered.unrecorded[name] = REASONS[probe.reach]
    elif not asked <= record["clock"] <= answered:
        gathered.unrecorded[name] = ELSEWHERE
    else:
        gathered.records.append((name, record))


def _since(record: dict[str, Any], since: float) -> bool:
    """Say whether a node that has ended handed its record over in time, and by the clock of this machine."""
    return bool(since <= record["clock"] <= time.monotonic())


def _told(probe: Probe) -> dict[str, Any] | None:
    answer = rpc_answer(probe)
    try:
        record = json.loads(answer) if isinstance(answer, str) else None
    except ValueError:
        return None
    return record if isinstance(record, dict) and {"clock", "marks"} <= record.keys() else None


def _fill(recording: Recording, gathered: _Gathered, start: float, end: float) -> None:
    records = [Record(name, record["process"], record["marks"]) for name, record in gathered.records]
    recording.events = matched(records, start, end)
    recording.nodes = tuple(sorted({record.node for record in records}))
    recording.length = end - start
    recording.unrecorded = {**gathered.unrecorded, **dict.fromkeys(_ended(recording, gathered), ENDED)}
    recording.notes = (*gathered.notes, *_missing(gathered.records, start))


def _ended(recording: Recording, gathered: _Gathered) -> list[str]:
    """Return who took part, according to others, and was not there any more to be asked."""
    peers = {event.peer for event in recording.events if event.kind != PUBLISH}
    peers |= {peer for event in recording.events if event.kind == PUBLISH for peer in event.peer.split(", ")}
    known = {*recording.nodes, *gathered.unrecorded, *LEFT_OUT, MASTER, "unknown", ""}
    return sorted(peers - known) if not gathered.notes else []


def _missing(records: Iterable[tuple[str, dict[str, Any]]], start: float) -> Iterator[str]:
    for name, record in records:
        for blind in record["blind"]:
            yield f"{name} does not record {blind}."
        if record["complete_from"] > start:
            late = record["complete_from"] - start
            yield f"{name} did more than it keeps: what it did in the first {late:.3g} s is missing."
