"""A separate node for a panel. The node runs in a separate process.

The node publishes and subscribes on one topic, and exchanges commands and reports with the kernel through a
channel. In one process, rospy has only one publisher and one subscriber for each topic. A panel in the kernel
would therefore change the latch, the queue size and the type of the student's publisher.
"""
