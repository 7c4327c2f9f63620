"""The set-up passes pip's settings to uv."""

from __future__ import annotations

from pathlib import Path

from course_pkg.setup.libraries import UV_SETTINGS, as_uv_variables


def test_the_mirror_in_pips_settings_is_used(tmp_path: Path) -> None:
    """The set-up converts pip's settings for indexes, find-links and certificates to variables for uv."""
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


def test_a_missing_folder_is_omitted() -> None:
    """The set-up ignores a missing folder in pip's settings."""
    words = as_uv_variables({"find-links": ["/none"], "extra-index-url": ["file:///none/simple"]}, {})
    assert words == UV_SETTINGS


def test_the_users_variables_for_uv_are_kept() -> None:
    """If the user has set a uv variable, its value does not change."""
    assert "UV_DEFAULT_INDEX" not in as_uv_variables(
        {"index-url": ["https://a.example"]}, {"UV_DEFAULT_INDEX": "x"}
    )
