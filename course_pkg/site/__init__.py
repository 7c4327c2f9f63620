"""The course as a static site. The pages work from a local folder, without a network and without a kernel."""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.site.commands import run_site

__all__ = ["run_site"]

__getattr__ = lazily(__name__, {"commands": "run_site"})
