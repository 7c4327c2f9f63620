"""uv uses the user's settings for pip."""

from __future__ import annotations

from pathlib import Path

from course_pkg.setup.libraries import UV_SETTINGS, as_uv_variables


def test_a_mirror_named_to_pip_is_used(tmp_path: Path) -> None:
    """Index, further indexes, find-links and certificates of pip become those of uv."""
    settings = {
        "index-url": ["https://mirror.example/simple"],
        "extra-index-url": ["https://a.example/simple", "https://b.example/simple"],
        "find-links": [str(tmp_path)],
        "cert": ["/etc/hosts"],
    }
    words = as_uv_variables(settings, {})
    assert words["UV_DEFAULT_INDEX"] == "https://mirror.example/simple"
    assert words["UV_INDEX"] == "https://a.example/simple https://b.example/simple"
    assert words["UV_FIND_LINKS"] == str(tmp_path)
    assert words["SSL_CERT_FILE"] == "/etc/hosts"


def test_a_folder_that_is_not_there_is_left_out() -> None:
    """A missing folder of wheels or a missing local index is left out, as pip does; uv would stop."""
    words = as_uv_variables({"find-links": ["/none"], "extra-index-url": ["file:///none/simple"]}, {})
    assert words == UV_SETTINGS


def test_what_the_user_tells_uv_stands() -> None:
    """A variable of uv that is already set is not replaced."""
    assert "UV_DEFAULT_INDEX" not in as_uv_variables(
        {"index-url": ["https://a.example"]}, {"UV_DEFAULT_INDEX": "x"}
    )
