"""The data of the panel "Break it" for its page: the list of cases, the score, and the open case."""

from __future__ import annotations

from typing import Literal, TypedDict


class ToolUse(TypedDict):
    """One use of a tool: the command, its output, and whether the command is still waiting for a response."""

    number: int
    tool: str
    shown: str
    said: str
    verdict: str
    waiting: bool


class Verdict(TypedDict, total=False):
    """The verdict on the student's answer; the panel also uses this data to show the solution.

    `server` is the text of the server's program, if the case has a server.
    """

    state: Literal["right", "half", "wrong", "shown"]
    words: str
    reason: str
    diagnosis: str
    remedy: str
    taught: str
    server: str


class CaseState(TypedDict, total=False):
    """The open case: its description, the outputs of the tools, the options, and the result of the answer."""

    number: int
    story: str
    phase: Literal["causing", "ready", "looking", "over"]
    looks: list[ToolUse]
    tools: list[dict[str, str]]
    diagnoses: list[str]
    remedies: list[str]
    verdict: Verdict


class Listed(TypedDict):
    """One case in the list of cases that the panel shows."""

    number: int
    state: str


class Score(TypedDict):
    """The number of all cases (`of`), of solved cases, and of cases with a right first answer."""

    solved: int
    first: int
    of: int


class Overview(TypedDict):
    """All cases, and the score."""

    cases: list[Listed]
    score: Score
