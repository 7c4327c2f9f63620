"""A recording in plain sentences without times, the same in every run that goes the same way."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from course_pkg.panels.timeline.waits import waits_of

if TYPE_CHECKING:
    from course_pkg.graph import Recording


def timeline_text(recording: Recording) -> str:
    """Return who waited for whom and who did not, one sentence a line, sorted; calls come first."""
    waits = waits_of(recording)
    lines = sorted(_called(each) for each in waits["calls"])
    lines += sorted(_published(each) for each in waits["streams"])
    return "\n".join(lines) or "Nothing was recorded."


def _called(wait: dict[str, Any]) -> str:
    servers = " and ".join(wait["servers"])
    words = f"{wait['node']} called {wait['service']}" + (f" and waited for {servers}" if servers else "")
    if wait["open"]:
        return f"{words}{'' if servers else ' and waited'}, to the end of the recording."
    if not servers:
        return f"{words}, and reached nobody."
    if wait["failed"] == wait["calls"]:
        return f"{words}, in vain."
    return f"{words}, at times in vain." if wait["failed"] else f"{words}."


def _published(stream: dict[str, Any]) -> str:
    words = f"{stream['node']} published {stream['topic']} and waited for nobody"
    if stream["heard_by"]:
        return f"{words}; {' and '.join(stream['heard_by'])} heard it."
    alone = stream["alone"] == stream["published"]
    return f"{words}; {'nobody was connected' if alone else 'nobody on record heard it'}."
