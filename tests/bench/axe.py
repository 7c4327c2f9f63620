"""Accessibility of a whole site, every rule of axe-core: `python tests/bench/axe.py [SITE]`.

SITE is the folder of a site, by default the last that `./course site` wrote. Each page is looked at wide and
narrow, light and dark, with and without the search open; the suite spares itself what cannot differ.
"""

from __future__ import annotations

import sys
from itertools import product
from pathlib import Path

from course_pkg.provision import Places
from tests.browser.chromium import chromium
from tests.site.test_pages import AXE, COLOURS, WIDTHS, look_for, open_page, pages, reader, violations


def main() -> None:
    """Print each violation, and how many there are on how many pages."""
    site = Path(sys.argv[1]) if len(sys.argv) > 1 else Places.of().cache / "site" / "pages"
    count = 0
    with chromium() as browser:
        for width, colours in product(WIDTHS, COLOURS):
            with reader(browser, width, colours) as page:
                for name in pages(site):
                    open_page(page, site, name)
                    page.evaluate(AXE)
                    found = violations(page)
                    look_for(page, "service")
                    found += violations(page)
                    count += len(found)
                    for each in found:
                        print(f"{name} {width} {colours}: {each}")
    print(f"{count} violations on {len(pages(site))} pages, {len(WIDTHS) * len(COLOURS)} ways each")


if __name__ == "__main__":
    main()
