"""What this process has registered, by way of rospy's own books, which the master may have forgotten."""

from __future__ import annotations

from typing import Any

import rospy
from rospy.impl.registration import (
    RegManager,
    get_registration_listeners,
    get_service_manager,
    get_topic_manager,
)

from course_pkg.graph.rpc import MasterClient

HASTENED = "hastened_by_course"  # an attribute of a registrar that is told already


def node_known(master: MasterClient) -> bool:
    """Whether the master knows this process's node, at its address."""
    return master.lookup_node(rospy.get_name()) == str(rospy.get_node_uri())


def register_all(master: MasterClient) -> None:
    """Register again all that rospy has on its books: a master that was restarted knows none of it."""
    node, uri = rospy.get_name(), rospy.get_node_uri()
    if (manager := registration_manager()) is not None:
        manager.master_uri = manager.handler.masterUri = master.uri  # it may be another than before
    for service, service_uri in get_service_manager().get_services():
        master.register_service(node, service, service_uri, uri)
    for topic, kind in get_topic_manager().get_publications():
        master.register_publisher(node, topic, kind, uri)
    for topic, kind in get_topic_manager().get_subscriptions():
        publishers = master.register_subscriber(node, topic, kind, uri)
        if manager is not None:
            manager.publisher_update(topic, publishers)


def unregister_all(master: MasterClient) -> None:
    """Withdraw all that rospy has on its books, and leave the books as they are."""
    node, uri = rospy.get_name(), rospy.get_node_uri()
    for service, service_uri in get_service_manager().get_services():
        master.unregister_service(node, service, service_uri)
    for topic, _ in get_topic_manager().get_publications():
        master.unregister_publisher(node, topic, uri)
    for topic, _ in get_topic_manager().get_subscriptions():
        master.unregister_subscriber(node, topic, uri)


def registration_manager() -> Any:  # noqa: ANN401 -- rospy has no types
    """Return rospy's own registrar, or None where rospy is built differently."""
    for listener in get_registration_listeners().listeners:
        if isinstance(listener, RegManager):
            return listener
    return None


def hasten_shutdown() -> None:
    """Spare the end of the process the 0.5 s for which rospy's registrar sleeps through its wake-up call."""
    manager = registration_manager()
    if manager is None or getattr(manager, HASTENED, False):
        return
    setattr(manager, HASTENED, True)

    def wake(_reason: str) -> None:
        with manager.cond:
            manager.cond.notify_all()

    rospy.core.add_shutdown_hook(wake)
