"""The protocols of ROS 1: a client of the master with time limits, registrations, and probes of nodes."""
