"""A separate node for a panel. The node is a separate process.

It publishes and subscribes on one topic, and exchanges commands and reports with the kernel through a
channel.

The process is separate because rospy has only one publisher and one subscriber for each topic in a process.
In the kernel, the panel and the student's code would share this publisher and subscriber, including the
latch, queue size and type.
"""
