"""The registrations of this process, from rospy's own lists.

After a restart of the master, this process must send its registrations again.
"""

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
    """Return whether the master knows this process's node, with its current address."""
    return master.lookup_node(rospy.get_name()) == str(rospy.get_node_uri())


def register_all(master: MasterClient) -> None:
    """Register all entries of rospy's lists at a restarted master."""
    node, uri = rospy.get_name(), rospy.get_node_uri()
    if (manager := registration_manager()) is not None:
        manager.master_uri = manager.handler.masterUri = master.uri  # The master may have a new address.
    for service, service_uri in get_service_manager().get_services():
        master.register_service(node, service, service_uri, uri)
    for topic, kind in get_topic_manager().get_publications():
        master.register_publisher(node, topic, kind, uri)
    for topic, kind in get_topic_manager().get_subscriptions():
        publishers = master.register_subscriber(node, topic, kind, uri)
        if manager is not None:
            manager.publisher_update(topic, publishers)


def registration_manager() -> RegManager | None:
    """Return rospy's object for registrations, or None if this rospy has no such object."""
    managers = (each for each in get_registration_listeners().listeners if isinstance(each, RegManager))
    return next(managers, None)
