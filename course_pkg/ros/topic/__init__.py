"""A separate node that publishes and subscribes on one topic, for a panel: a process with a channel.

It is a process because rospy has one publisher and one subscriber of a topic for each process: in the kernel,
a panel's latch, queue and type would be those of the student's own publisher and subscriber as well.
"""
