"""The protocols of ROS 1: the bounded client of the master, registrations, probes and service proxies."""
