"""What a node of the course tells by its XML-RPC interface beyond what every node tells.

http://wiki.ros.org/ROS/Slave_API. `getBusStats` has a place for the statistics of services, which rospy
leaves empty; `getCourseRecord` is the course's own. Nodes that have neither are asked in vain, and say so.
"""

from __future__ import annotations

import json
from typing import Any

from rospy.impl.masterslave import ROSHandler
from rospy.impl.registration import get_service_manager

from course_pkg.graph.taps import Method, Tap
from course_pkg.graph.trace import recorder

RECORD = "getCourseRecord"
STATISTICS = "getBusStats"
BLIND = "who calls its services: this rospy reports otherwise"


def extend_slave() -> None:
    """Have this process's node answer for what it has recorded."""
    setattr(ROSHandler, RECORD, _record)
    tap = Tap(
        ROSHandler, STATISTICS, ("args", "kwds"), _counting
    )  # rospy has wrapped it to check its arguments
    if tap.fits():
        tap.put()
    else:
        recorder().blind.add(BLIND)


def _record(_handler: ROSHandler, _caller_id: str, since: float) -> tuple[int, str, str]:
    """Return what was recorded since then (s of time.monotonic()), as JSON: XML takes ten times as long."""
    return 1, "", json.dumps(recorder().since(float(since)))


def _counting(bare: Method) -> Method:
    def get_bus_stats(*args: Any, **kwds: Any) -> Any:  # noqa: ANN401 -- what XML-RPC takes
        code, words, stats = bare(*args, **kwds)
        if code == 1 and len(stats) == 3 and not stats[2]:
            stats = [*stats[:2], _service_stats()]
        return code, words, stats

    return get_bus_stats


def _service_stats() -> list[list[object]]:
    """Return [service, [caller, requests, when last, how many run]*] for each service of this node."""
    names = sorted({name for name, _ in get_service_manager().get_services()})
    return [[name, recorder().tally.callers(name)] for name in names]
