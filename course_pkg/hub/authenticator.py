"""JupyterHub's authenticator for one-time passwords."""

from __future__ import annotations

import asyncio
from pathlib import Path

from jupyterhub.auth import Authenticator
from traitlets import Unicode

from course_pkg.hub.passwords import Passwords


class OneTimeAuthenticator(Authenticator):  # type: ignore[misc]  # The base class has no types.
    """Accepts each one-time password once."""

    passwords = Unicode(help="the file with the hashes of the passwords").tag(config=True)

    async def authenticate(self, handler: object, data: dict[str, str]) -> str | None:  # noqa: ARG002 -- of the base class
        """Return the user's name, or None if the password is wrong or was used before."""
        name, password = data["username"], data["password"]
        record = Passwords(Path(self.passwords))
        return name if await asyncio.to_thread(record.use, name, password) else None
