"""The course as a static site: pages that open from a folder, with no network and no kernel."""

from course_pkg.lazy import lazily

__all__ = ["run_site"]

__getattr__ = lazily(__name__, {"command": "run_site"})
