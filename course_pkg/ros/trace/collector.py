"""Collect the records of the nodes on the graph, with a time limit."""

from __future__ import annotations

import json
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from course_pkg.errors import GraphError
from course_pkg.ros.protocol.master_api import MasterClient
from course_pkg.ros.protocol.probe import Probe, Reach, ask_all, rpc_answer, rpc_probe
from course_pkg.ros.trace.handover import handovers
from course_pkg.ros.trace.matching import NodeRecord, match_events
from course_pkg.ros.trace.recorder import recorder
from course_pkg.ros.trace.recording import GET_RECORD, MASTER, PUBLISH, ProcessRecord, Recording

# Wait up to this time in s for the responses of all nodes; a response with 20,000 spans takes 0.3 s.
TIMEOUT = 1.0
LEFT_OUT = ("/rosout",)  # This node receives only log messages, which are not recorded.
REASONS = {
    Reach.REFUSED: "its process has ended",
    Reach.SILENT: f"it did not answer within {TIMEOUT:g} s, so it is paused or busy",
    Reach.LOST: "it could not be reached, or it closed the connection",
    Reach.ANSWERED: "it keeps no record, because it is not a Python node of the course",
}
ELSEWHERE = "it runs on another machine, and the clock of that machine differs"
ENDED = "it ended before the recording ended, and its record was lost"


@dataclass
class _Collected:
    records: list[tuple[str, ProcessRecord]] = field(default_factory=list)
    unrecorded: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


@contextmanager
def recorded(node: str, uri: str, master: MasterClient) -> Iterator[Recording]:
    """Record all nodes during the `with` block; `node` and `uri` identify the kernel's node.

    The recording is empty until the `with` block ends.
    """
    recording = Recording(node=node)
    with handovers(node, uri, master):
        start = time.monotonic()
        try:
            yield recording
        finally:
            end = time.monotonic()
            _fill(recording, _collect(node, master, start), start, end)


def _collect(node: str, master: MasterClient, since: float) -> _Collected:
    own = recorder()
    handed_over = [each for each in list(own.handed_over) if _in_time(each[1], since)]
    collected = _Collected([(node, own.since(since)), *handed_over])
    try:
        uris = master.lookup_all(master.system_state().nodes, ())[0]
    except GraphError as error:
        collected.notes.append(f"The other nodes are not known, because the master did not answer. {error}")
        return collected
    others = {name: uri for name, uri in uris.items() if name != node and name not in LEFT_OUT}
    probes = {name: rpc_probe(uri, GET_RECORD, since) for name, uri in others.items()}
    asked = time.monotonic()
    ask_all(list(probes.values()), TIMEOUT)
    answered = time.monotonic()
    for name, probe in probes.items():
        _add_answer(collected, name, probe, asked, answered)
    return collected


def _add_answer(collected: _Collected, name: str, probe: Probe, asked: float, answered: float) -> None:
    record = _answered_record(probe)
    if record is None:
        collected.unrecorded[name] = REASONS[probe.reach]
    elif not asked <= record["clock"] <= answered:
        collected.unrecorded[name] = ELSEWHERE
    else:
        collected.records.append((name, record))


def _in_time(record: ProcessRecord, since: float) -> bool:
    """Return whether a record was written during the recording, according to this machine's clock."""
    return since <= record["clock"] <= time.monotonic()


def _answered_record(probe: Probe) -> ProcessRecord | None:
    answer = rpc_answer(probe)
    try:
        record: ProcessRecord | None = json.loads(answer) if isinstance(answer, str) else None
    except ValueError:
        return None
    return record if isinstance(record, dict) and {"clock", "spans"} <= record.keys() else None


def _fill(recording: Recording, collected: _Collected, start: float, end: float) -> None:
    records = [NodeRecord(name, record["process"], record["spans"]) for name, record in collected.records]
    recording.events = match_events(records, start, end)
    recording.nodes = tuple(sorted({record.node for record in records}))
    recording.length = end - start
    recording.unrecorded = {**collected.unrecorded, **dict.fromkeys(_ended(recording, collected), ENDED)}
    recording.notes = (*collected.notes, *_missing(collected.records, start))


def _ended(recording: Recording, collected: _Collected) -> list[str]:
    """Return the nodes in records of other nodes that ended before they sent their own records."""
    peers = {event.peer for event in recording.events if event.kind != PUBLISH}
    peers |= {peer for event in recording.events if event.kind == PUBLISH for peer in event.peer.split(", ")}
    known = {*recording.nodes, *collected.unrecorded, *LEFT_OUT, MASTER, "unknown", ""}
    return sorted(peers - known) if not collected.notes else []


def _missing(records: Iterable[tuple[str, ProcessRecord]], start: float) -> Iterator[str]:
    for name, record in records:
        for unsupported in record["unsupported"]:
            yield f"{name} does not record {unsupported}."
        if record["complete_from"] > start:
            late = record["complete_from"] - start
            yield f"The memory of {name} was full, so the records of the first {late:.3g} s are missing."
