"""A shop with a counter and a camera, and three designs of one job, measured: greet who comes.

The names are looked up on first use; none of them needs rospy.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.shop.cases import CASES, OPTIONS
    from course_pkg.shop.counter import Counter, Visit
    from course_pkg.shop.drawing import shop_picture
    from course_pkg.shop.eye import Eye, await_customer
    from course_pkg.shop.findings import Findings, side_by_side
    from course_pkg.shop.frames import frame_points, sees_customer
    from course_pkg.shop.till import OpenTill, Printer
    from course_pkg.shop.trial import age_of_knowledge, try_out
    from course_pkg.shop.watch import Customer, Watch

__all__ = [
    "CASES",
    "OPTIONS",
    "Counter",
    "Customer",
    "Eye",
    "Findings",
    "OpenTill",
    "Printer",
    "Visit",
    "Watch",
    "age_of_knowledge",
    "await_customer",
    "frame_points",
    "sees_customer",
    "shop_picture",
    "side_by_side",
    "try_out",
]

__getattr__ = lazily(
    __name__,
    {
        "cases": "CASES OPTIONS",
        "counter": "Counter Visit",
        "drawing": "shop_picture",
        "eye": "Eye await_customer",
        "findings": "Findings side_by_side",
        "frames": "frame_points sees_customer",
        "till": "OpenTill Printer",
        "trial": "age_of_knowledge try_out",
        "watch": "Customer Watch",
    },
)
