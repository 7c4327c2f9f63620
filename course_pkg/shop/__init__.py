"""The shop that several chapters use: its counter, its camera, and the printer of its cash register.

This package does not need rospy.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.shop.counter import Counter, Visit
    from course_pkg.shop.pictures import frame_points, sees_customer, shop_picture
    from course_pkg.shop.printer import Printer
    from course_pkg.shop.watch import Customer, Eye, Watch, await_customer

__all__ = [
    "Counter",
    "Customer",
    "Eye",
    "Printer",
    "Visit",
    "Watch",
    "await_customer",
    "frame_points",
    "sees_customer",
    "shop_picture",
]

__getattr__ = lazily(
    __name__,
    {
        "counter": "Counter Visit",
        "pictures": "frame_points sees_customer shop_picture",
        "printer": "Printer",
        "watch": "Customer Eye Watch await_customer",
    },
)
