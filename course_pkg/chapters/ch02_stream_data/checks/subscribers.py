"""Starts and ends the student's subscribers."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from course_pkg.checking import CheckContext, Its, matches
from course_pkg.waiting import at_this_load

KEEPER = """
import rospy

kept = []


def begin(start, *args):
    started = start(*args)
    kept.extend(started if isinstance(started, (list, tuple)) else [started])
    subscribers = [each for each in kept if isinstance(each, rospy.Subscriber)]
    return [each.resolved_name for each in subscribers]


def end():
    while kept:
        subscriber = kept.pop()
        if hasattr(subscriber, "unregister"):
            subscriber.unregister()
"""
# The student's function must return within this time in s; on an idle machine, it takes a few ms.
RETURNS = 1.5
NO_SUBSCRIBER = "Return the rospy.Subscriber object. The check uses this object to unregister the subscriber."
OTHER_ORDER = (
    "The two subscribers are in the wrong order. Return the subscriber of the topic `angles` first, "
    "and then the subscriber of the topic `orders`."
)
NO_TWO = (
    "Return a list of two rospy.Subscriber objects. The check uses these objects to unregister the "
    "subscribers."
)
NEVER_RETURNS = (
    "The function does not return. Return after you create the subscriber: rospy calls the "
    "callback in another thread."
)


@contextmanager
def running_subscribers(
    context: CheckContext, start: str, *args: object, worded: str, topics: Sequence[str]
) -> Iterator[None]:
    """Call the student's function, which returns its subscribers; unregister them after the `with` block."""
    context.prepare(KEEPER)
    try:
        started = context.run(
            "begin",
            Its(start),
            *args,
            within=at_this_load(RETURNS),
            worded=worded,
            hints=[(matches("TimesUp"), NEVER_RETURNS)],
        )
        names = started.returned()
        swapped = len(topics) > 1 and names == list(reversed(topics))
        context.require(
            "the subscriber is returned" if len(topics) == 1 else "two subscribers are returned",
            holds=isinstance(names, list) and len(names) == len(topics) and not swapped,
            expected=f"subscribers: {len(topics)}, in the order that the exercise describes",
            actual=names,
            hints=OTHER_ORDER if swapped else NO_SUBSCRIBER if len(topics) == 1 else NO_TWO,
        )
        yield
    finally:
        context.run("end", worded=worded)
