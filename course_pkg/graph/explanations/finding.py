"""Finding the row of the table that fits the words of one error."""

from __future__ import annotations

import re

from course_pkg.graph.explanations.explanation import Explanation
from course_pkg.graph.explanations.from_calls import FROM_CALLS
from course_pkg.graph.explanations.from_graph import FROM_GRAPH
from course_pkg.graph.explanations.from_handlers import FROM_HANDLERS

TABLE = (*FROM_HANDLERS, *FROM_GRAPH, *FROM_CALLS)


def known(words: str) -> Explanation | None:
    """Return the explanation of an error given as `TypeName: message`, None for one not in the table."""
    for pattern, cause, remedy, chapter in TABLE:
        if re.search(pattern, words):
            return Explanation(cause, remedy, chapter)
    return None
