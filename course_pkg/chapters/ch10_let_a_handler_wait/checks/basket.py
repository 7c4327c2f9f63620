"""10.3: a handler that waits for a change that another handler makes."""

from __future__ import annotations

from threading import Timer

from course_pkg.chapters.ch10_let_a_handler_wait.checks.shop_in_kernel import TRIGGER
from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.kernel.small_stacks import SMALL_STACKS
from course_pkg.checking.peers.service_calls import Reply, Service
from course_pkg.checking.plain_values import Message

# In the basket that the check creates, the handler of /take waits for an item for at most this time in s.
LIMIT = 1.6
SLACK = 0.8  # SLACK is the additional time in s that a call may take on a busy machine.
LATER = 0.3  # An item is put into the basket after this time in s.
# After this time in s, the last of several items is put into the basket, or the check wakes all threads. If
# the time limit starts again at this moment, the call takes too long.
LAST = 1.2
KERNEL_CODE = (
    SMALL_STACKS
    + """
import sys

import rospy
from std_srvs.srv import Trigger


class CheckedBasket:
    def open(self, kind, limit, put, take):
        small_stacks.begin()
        self.basket = kind(limit)
        self.services = [
            rospy.Service(put, Trigger, self.basket.handle_put),
            rospy.Service(take, Trigger, self.basket.handle_take),
        ]

    def open_another(self, kind, limit, put):
        self.services.append(rospy.Service(put, Trigger, kind(limit).handle_put))

    def wake(self):
        '''Wake the waiting threads although nothing has changed.'''
        own = [*vars(self.basket).values()]
        for _ in range(3):  # A condition can be in a list or in another object of the student.
            for each in own.copy():
                if isinstance(each, (list, tuple, set)):
                    own += each
                elif isinstance(each, dict):
                    own += each.values()
                elif type(each).__module__ == "__main__":
                    own += getattr(each, "__dict__", {}).values()
        named = vars(sys.modules[type(self.basket).__module__]).values()
        found = {id(each): each for each in [*own, *named] if issubclass(type(each), threading.Condition)}
        for condition in found.values():
            with condition:
                condition.notify_all()

    def close(self):
        small_stacks.end()
        for service in self.services:
            service.shutdown("checked")


checked_basket = CheckedBasket()
"""
)
FOREVER = (
    "The handler of /take waits longer than the time limit. This limit starts at the beginning of the "
    "call, so pass only the remaining time to `wait` or `wait_for`."
)
HELD = (
    "/put did not respond while a call of /take was waiting. Use the method `wait` or `wait_for` of "
    "the condition, which releases the lock while the thread waits."
)
NOT_WOKEN = (
    "An item came, but the waiting call did not return. In handle_put, call notify_all() or "
    "notify() after you have changed the number of items."
)
TOO_MANY = (
    "The handler of /take returned an item although the basket was empty. After a thread has woken up, "
    "check again whether the basket contains an item: use a `while` loop or `wait_for`."
)
TOO_EARLY = (
    "The handler of /take returned before its time limit was over. If a thread wakes up and the basket "
    "is empty, let the thread wait again for the remaining time."
)
FULL = (
    "The basket did not accept an item, but a basket has no maximum number of items. Add one item in "
    "each call of /put."
)
SHARED = (
    "Two baskets share their items, so the second basket was not empty at first. Create the items in "
    "__init__ and store them in self, not in the class."
)
ERRORS = [
    (
        matches("un-acquired lock"),
        "The methods `wait` and `notify` need the lock of the condition. Call these methods inside "
        "`with self.changed:`.",
    ),
    (
        matches("field message must be"),
        "The field `message` has to be a string. Convert the number with str(...).",
    ),
    (
        matches("returned None"),
        "The handler returned None, not a response. Return a response in every case.",
    ),
    (
        matches("cannot process request"),
        'An empty basket is not an error. Return success=False and the message "empty".',
    ),
]


@part(
    "10.3",
    points=3,
    goal=(
        "Write a basket with the services /put and /take. A call of /take waits for an item, but not "
        "longer than the time limit."
    ),
    needs=["Basket"],
    deadline=45.0,
)
def wait_for_another_call(context: CheckContext) -> None:
    """Take an item from a full and from an empty basket; put an item into the basket while a client waits.

    At the end, let several clients wait for items at the same time.
    """
    *names, another = [f"/{context.random.word()}" for _ in range(3)]
    context.prepare(KERNEL_CODE)
    opened = context.run("checked_basket.open", Its("Basket"), LIMIT, *names, worded=f"Basket({LIMIT:g})")
    context.require("a Basket can be created with a time limit", holds=not opened.error, actual=opened.error)
    put = context.service(names[0], TRIGGER, hints=[(matches("TimesUp"), HELD), *ERRORS])
    take = context.service(
        names[1], TRIGGER, hints=[(matches("TimesUp"), FOREVER), *ERRORS], timeout=2 * LIMIT + SLACK
    )
    try:
        _puts_and_takes(context, put, take)
        _shares_nothing(context, another, put, take)
        _waits_for_an_item(context, put, take)
        _shares_the_items(context, put, take)
    finally:
        context.run("checked_basket.close")


def _puts_and_takes(context: CheckContext, put: Service, take: Service) -> None:
    count = context.random.integer(12, 24)
    for number in range(1, count + 1):
        response = put()
        context.require(
            "/put adds one to the number of items",
            holds=response.success or response.message == str(number),
            expected=f"success=True, and the message {number}",
            actual=f"success={response.success}, and the message {response.message}",
            hints=FULL,
        )
        _answer(context, "/put adds one to the number of items", response, True, str(number))
    for number in range(count - 1, -1, -1):
        response = take()
        _at_once(context, "if the basket contains an item, /take returns immediately", take.took)
        _answer(context, "/take subtracts one from the number of items", response, True, str(number))


def _shares_nothing(context: CheckContext, another: str, put: Service, take: Service) -> None:
    """Put an item into the first basket, and then an item into a new basket.

    If the new basket does not have exactly one item, the two baskets share their items.
    """
    put()
    worded = f"Basket({LIMIT:g})"
    opened = context.run("checked_basket.open_another", Its("Basket"), LIMIT, another, worded=worded)
    context.require("a Basket can be created with a time limit", holds=not opened.error, actual=opened.error)
    response = context.service(another, TRIGGER, hints=ERRORS)()
    context.expect(
        "/put adds one to the number of items", expected="1", actual=response.message, hints=SHARED
    )
    take()


def _answer(context: CheckContext, assertion: str, response: Message, success: bool, message: str) -> None:
    context.expect(
        assertion,
        expected=[success, message],
        actual=[response.success, response.message],
        hints=[
            (
                lambda actual: actual[0] is not success and actual[1] == message,
                (
                    "The message is right, but the field `success` is wrong. In this case, "
                    f"`success` must be {success}."
                ),
            ),
            (
                lambda actual: actual[1] != "empty" and message == "empty",
                ('No item came, but the response is wrong. Return success=False and the message "empty".'),
            ),
            (
                ANYTHING,
                (
                    "The message is wrong. Return the number of items in the basket after the call, as "
                    "a string."
                ),
            ),
        ],
    )


def _at_once(context: CheckContext, assertion: str, took: float) -> None:
    context.require(
        assertion,
        holds=took < SLACK,
        expected="an immediate response",
        actual=f"a response after {took:.1f} s",
        hints=(
            "An item was in the basket before the call, but the handler waited. Wait only if the "
            "basket is empty."
        ),
    )


def _waits_for_an_item(context: CheckContext, put: Service, take: Service) -> None:
    waking = Timer(LAST, context.run, ("checked_basket.wake",))
    waking.start()
    response = take()
    waking.join()
    context.require(
        "if the basket stays empty, /take reports this when the time limit is over",
        holds=response.success or LIMIT - 0.1 <= take.took < LIMIT + SLACK,
        expected=f"a response after {LIMIT:g} s",
        actual=f"a response after {take.took:.1f} s",
        hints=FOREVER if take.took > LIMIT else TOO_EARLY,
    )
    context.require(
        "each item is taken once",
        holds=not response.success,
        expected="no item from an empty basket",
        actual="an item",
        hints=TOO_MANY,
    )
    _answer(
        context,
        "if the basket stays empty, /take reports this when the time limit is over",
        response,
        False,
        "empty",
    )
    later = Timer(LATER, put)
    later.start()
    response = take()
    later.join()
    context.require(
        "a call of /put gets a response while /take waits",
        holds=put.took < SLACK,
        expected="an immediate response",
        actual=f"a response after {put.took:.1f} s",
        hints=HELD,
    )
    context.require(
        "a waiting call of /take returns when an item comes",
        holds=response.success and take.took < LIMIT - 0.2,
        expected=f"a response {LATER:g} s after the call",
        actual=f"success={response.success} after {take.took:.1f} s",
        hints=NOT_WOKEN,
    )


def _shares_the_items(context: CheckContext, put: Service, take: Service) -> None:
    """Let several clients wait, and put fewer items than clients into the basket, one after another."""
    items = context.random.integer(2, 4)
    clients = items + context.random.integer(2, 4)
    pause = (LAST - LATER) / (items - 1)
    timers = [Timer(LATER + pause * number, put) for number in range(items)]
    for timer in timers:
        timer.start()
    replies = take.at_once([{}] * clients)
    for timer in timers:
        timer.join()
    _each_item_once(context, replies, items)
    late = max(reply.took for reply in replies)
    context.require(
        "no call takes longer than the time limit",
        holds=late < LIMIT + SLACK,
        expected=f"a response after {LIMIT:g} s at the latest",
        actual=f"a response after {late:.1f} s",
        hints=FOREVER,
    )


def _each_item_once(context: CheckContext, replies: list[Reply], items: int) -> None:
    taken = sum(reply.response.success for reply in replies)
    context.expect(
        "each item is taken once",
        expected=items,
        actual=taken,
        hints=[(lambda actual: actual > items, TOO_MANY), (ANYTHING, NOT_WOKEN)],
    )
