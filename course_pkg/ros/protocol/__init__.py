"""The protocols of ROS 1: a client for the master, registrations, and probes of nodes."""
