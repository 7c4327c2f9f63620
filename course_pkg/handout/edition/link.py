"""The link with which nbgitpuller copies the edition into a student's account on a JupyterHub.

Its form is that of https://nbgitpuller.readthedocs.io/en/latest/link.html.
"""

from __future__ import annotations

from urllib.parse import quote, urlencode, urlsplit

from course_pkg.errors import HandoutError


def pull_link(hub: str, repository: str, branch: str, notebook: str) -> str:
    """Return the link that pulls `branch` of `repository` and opens `notebook`, a path inside of it.

    `hub` is the address of the JupyterHub. Raises HandoutError if one of the addresses begins with neither
    https:// nor http://.
    """
    for option, address in (("--hub", hub), ("--repository", repository)):
        parts = urlsplit(address)
        if parts.scheme not in ("http", "https") or not parts.netloc:
            raise HandoutError(
                f"{option} {address} is not an address that nbgitpuller can use. Write one that begins with "
                "https://, such as https://hub.example.edu or https://git.example.edu/ros/course.git."
            )
    folder = repository.rstrip("/").rpartition("/")[2].removesuffix(".git")  # where nbgitpuller clones to
    query = {"repo": repository, "urlpath": f"lab/tree/{folder}/{notebook}", "branch": branch}
    return f"{hub.rstrip('/')}/hub/user-redirect/git-pull?{urlencode(query, quote_via=quote, safe='')}"
