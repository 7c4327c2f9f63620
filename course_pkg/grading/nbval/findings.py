"""Sentences for students about the cells that nbval ran."""

from __future__ import annotations

import re

COLOUR = re.compile(r"\x1b\[[\d;]*m")
RAISED = re.compile(r"^(?P<error>[A-Za-z_][\w.]*): (?P<message>.*)$", re.MULTILINE)
OWN_LIMIT = re.compile(r"gave no result within (?P<seconds>\d+) s")
LIMIT = re.compile(r"Timeout of (?P<seconds>\d+) seconds exceeded (?:while )?executing")
SENTENCES = (  # Each entry contains a text that nbval 0.11 or pytest prints, and an explanation for students.
    (
        "Missing output fields",
        "With the right answers, this cell shows more output.",
    ),
    ("Unexpected output fields", "With the right answers, this cell shows less output."),
    (
        "dissimilar number of outputs",
        "With the right answers, this cell has a different number of outputs.",
    ),
    ("Cell outputs differ", "The output of the cell is different from the output with the right answers."),
    ("Kernel dead", "The cell was not run, because the kernel had ended in an earlier cell."),
    ("waiting for output", "The kernel ended or sent no output while the cell ran."),
    ("previous cell timed out", "An earlier cell took too long, so this cell was not compared."),
)
OTHER = "The result of the cell is different from the result with the right answers."


def finding(words: str) -> str:
    """Return a sentence that tells the student the result of a cell, or "" if `words` is empty.

    `words` is the text that nbval has printed about a cell.
    """
    text = COLOUR.sub("", words)
    if not text.strip():
        return ""
    if limit := LIMIT.search(text) or OWN_LIMIT.search(text):
        return f"The cell was stopped, because it ran for more than {limit['seconds']} s."
    if "caused an exception" in text and (raised := RAISED.findall(text)):
        error, message = raised[-1]
        return f"The cell raised {error}: {message}"
    return next((sentence for part, sentence in SENTENCES if part.lower() in text.lower()), OTHER)
