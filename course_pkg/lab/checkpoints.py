"""Checkpoints of notebooks, kept in the cache, so that a checkout holds nothing that nobody wrote."""

from __future__ import annotations

from pathlib import Path

from jupyter_server.services.contents.filecheckpoints import AsyncFileCheckpoints
from traitlets import Unicode


class CachedCheckpoints(AsyncFileCheckpoints):  # type: ignore[misc]  # of an untyped package
    """Keeps each notebook's checkpoint at the notebook's own path, below another folder than the server's."""

    folder = Unicode(help="where to keep them").tag(config=True)

    def checkpoint_path(self, checkpoint_id: str, path: str) -> str:
        """Return the file for a checkpoint of the notebook at `path`, and make its folder."""
        self._get_os_path(path.strip("/"))  # raises where that leads out of the server's folder
        notebook = Path(self.folder, path.strip("/"))
        with self.perm_to_403():
            notebook.parent.mkdir(parents=True, exist_ok=True)
        return str(notebook.with_name(f"{notebook.stem}-{checkpoint_id}{notebook.suffix}"))
