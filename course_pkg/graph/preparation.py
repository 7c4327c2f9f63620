"""What makes a process that has called init_node() a node of the course."""

from __future__ import annotations

from course_pkg.graph.farewell import say_farewell_at_the_end
from course_pkg.graph.handshake import guard_against_idle_connections
from course_pkg.graph.registrar import hasten_shutdown
from course_pkg.graph.service_taps import tap_services
from course_pkg.graph.slave import extend_slave
from course_pkg.graph.topic_taps import tap_topics


def prepare_node() -> None:
    """Make this process's node one that no idle connection blocks, that is recorded, and that ends at once.

    Call it right after rospy.init_node(), before anything is served, published or called. A second call
    changes nothing.
    """
    guard_against_idle_connections()
    hasten_shutdown()
    tap_services()
    tap_topics()
    extend_slave()
    say_farewell_at_the_end()
