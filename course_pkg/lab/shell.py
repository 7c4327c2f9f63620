"""The shell of the course's terminals."""

from pathlib import Path

SHELL = ("bash", "--rcfile", str(Path(__file__).with_name("bashrc")))
