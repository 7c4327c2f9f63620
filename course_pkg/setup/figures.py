"""How a kernel shows the figures of matplotlib: as SVG, the same for the same data.

nbval compares the text of a figure's output and leaves the SVG out: see authoring/nbval_plugin.py.
"""

from __future__ import annotations

import logging
import sys

# Without a salt, the ids in an SVG are random. Unless "Date" is None, its metadata has the time of the run.
# With "none", a text stays a text: it is small, and a program can read it aloud.
RC = {"svg.hashsalt": "course_pkg", "svg.fonttype": "none"}
SETTINGS = {
    "figure_formats": {"svg"},
    "print_figure_kwargs": {"bbox_inches": "tight", "metadata": {"Date": None}},
    "rc": RC,
}


def set_up_figures() -> None:
    """Make this kernel show figures as SVG; outside of IPython, do nothing.

    It imports nothing: matplotlib's inline backend reads the settings when it draws its first figure. If it
    has drawn one already, the settings hold from the next figure on.
    """
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    if shell is None:
        return
    shell.config.InlineBackend.update(SETTINGS)
    # On a new machine, matplotlib logs that it builds its cache of fonts, and a cell would show that.
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    config = sys.modules.get("matplotlib_inline.config")
    if config and config.InlineBackend.initialized():
        sys.modules["matplotlib"].rcParams.update(RC)
        for name, value in SETTINGS.items():
            setattr(config.InlineBackend.instance(), name, value)
