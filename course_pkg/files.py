"""Write files completely or not at all; this module imports only the standard library."""

from __future__ import annotations

import os
from pathlib import Path


def write_atomically(path: Path, content: str | bytes, encoding: str = "utf-8") -> None:
    """Write `content` to the file at the path `path`, and create missing folders.

    During the write, another process reads either the complete old file or the complete new file. Raises
    OSError if the file cannot be written, and UnicodeEncodeError if `encoding` cannot represent the text. In
    both cases, the old file does not change.
    """
    data = content.encode(encoding) if isinstance(content, str) else content
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        draft.write_bytes(data)
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)
