"""The client that finds out whether anybody is there."""

from threading import Timer

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.checks.chapter_06.boxes import GEOMETRY, NO_RETURN, stops


@part(
    "06.2",
    points=2,
    goal="Return whether a service is there, or comes within the given time.",
    needs=["is_there"],
    deadline=20.0,
)
def is_anybody_there(exam: Exam) -> None:
    """Ask for one that is there, two that never answer, and one that comes while the student waits."""
    here, nowhere, killed, later = (f"/{exam.draw.word()}" for _ in range(4))
    exam.serve(here, GEOMETRY, lambda _: {})
    exam.absent(killed, stale=True)
    there = exam.run("is_there", here, 2.0)
    exam.expect(
        "True for a service that is there",
        expected=True,
        seen=there.value,
        hints={
            None: NO_RETURN,
            False: "The service was there. wait_for_service returns nothing when it succeeds.",
            (lambda seen: isinstance(seen, str)): "That is a text. True and False stand without quotes.",
        },
    )
    exam.hold(
        "at once for a service that is there",
        there.took < 1.0,
        expected="an answer at once",
        seen=f"an answer after {there.took:.1f} s",
        hints="Return as soon as it is there. wait_for_service does, and waits no longer than it must.",
    )
    exam.expect(
        "True for a service that is there",
        expected=True,
        seen=exam.run("is_there", here, 0.5).value,  # as long as those get that are not
        hints={False: "The service was there, and half a second is enough to see it."},
    )
    _never_there(exam, nowhere, "It said that a service is there that nobody serves.")
    _never_there(
        exam,
        killed,
        "The master still lists this one, but its process is gone. wait_for_service asks the server itself.",
    )
    Timer(1.3, exam.serve, [later, GEOMETRY, lambda _: {}]).start()
    exam.expect(
        "True for a service that comes in time",
        expected=True,
        seen=exam.run("is_there", later, 4.0, within=8.0).value,
        hints={False: "It came after 1.3 s, and there were 4. Wait for as long as `seconds` says."},
    )
    stops(exam, "is_there", nowhere, 3.0, catch="rospy.ROSException")


def _never_there(exam: Exam, name: str, hint: str) -> None:
    """Give half a second, in which rospy looks twice; three times as long is too long."""
    too_long = "It waited longer than it was told to. Give wait_for_service the limit: timeout=seconds."
    missing = exam.run(
        "is_there",
        name,
        0.5,
        within=3.0,
        hints={
            says("TimesUp"): too_long,
            says(
                "ROSException"
            ): "wait_for_service raises rospy.ROSException when the time is up. Catch that one.",
        },
    )
    exam.expect(
        "False for a service that does not come",
        expected=False,
        seen=missing.value,
        hints={None: "When the time was up, None was returned. Return False there.", True: hint},
    )
    exam.hold(
        "it waits no longer than it is told to",
        missing.took < 1.4,
        expected="an answer after 0.5 s or little more",
        seen=f"an answer after {missing.took:.1f} s",
        hints=too_long,
    )
