"""Faults of services, nodes and masters.

A fault is real: an object of the class Stage causes it on the running graph, and later removes it.

    with caused("stale") as stage:
        seen = stage.symptom()

The module `fault` describes one fault. The modules `program` and `stage` cause the fault, and `catalogue`
lists all faults. In the panel BreakIt, each fault is a case that students diagnose.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.faults.catalogue import caused, every_fault, named, names
    from course_pkg.faults.fault import Fault
    from course_pkg.faults.probes import TOOLS, probe
    from course_pkg.faults.program import Program, Seen
    from course_pkg.faults.stage import Stage

__all__ = [
    "TOOLS",
    "Fault",
    "Program",
    "Seen",
    "Stage",
    "caused",
    "every_fault",
    "named",
    "names",
    "probe",
]

__getattr__ = lazily(
    __name__,
    {
        "catalogue": "caused every_fault named names",
        "fault": "Fault",
        "probes": "TOOLS probe",
        "program": "Program Seen",
        "stage": "Stage",
    },
)
