"""What rospy in this process has registered, from rospy's own lists: the master may have forgotten it."""

from __future__ import annotations

import rospy
from rospy.impl.registration import (
    RegManager,
    get_registration_listeners,
    get_service_manager,
    get_topic_manager,
)

from course_pkg.ros.protocol.master_api import MasterClient


def node_known(master: MasterClient) -> bool:
    """Return whether the master knows this process's node, at its address."""
    return master.lookup_node(rospy.get_name()) == str(rospy.get_node_uri())


def register_all(master: MasterClient) -> None:
    """Register again all that rospy has in its lists: a master that was restarted knows none of it."""
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


def registration_manager() -> RegManager | None:
    """Return the object by which rospy registers, or None where rospy is built differently."""
    managers = (each for each in get_registration_listeners().listeners if isinstance(each, RegManager))
    return next(managers, None)
