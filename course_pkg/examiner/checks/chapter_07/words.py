"""What several checks of this chapter say or look for."""

from course_pkg.examiner.ledger import says

NO_RETURN = "None was returned, as by a function that comes to its end without a return line."
OWN_WORDS = says("cannot process request: (?!(service )?handler returned)")  # else rospy found the words
