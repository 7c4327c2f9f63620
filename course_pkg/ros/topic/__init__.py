"""A separate node for a panel, which publishes and subscribes on one topic: a process with a channel.

It is a separate process because rospy has only one publisher and one subscriber of a topic in each process.
In the kernel, the panel and the student would share them, with the same latch, queue size and type.
"""
