"""Make a kernel show matplotlib's figures as SVG. The same data always give the same SVG.

nbval compares the text of a figure's output, but not the SVG: see authoring/nbval_figures.py.
"""

from __future__ import annotations

import logging
import sys

# With this salt, the ids in an SVG are the same in every run. With the date None, an SVG does not contain the
# time of the run. With the font type "none", an SVG contains its letters as text. Such an SVG is smaller, and
# a screen reader can read it.
RC = {"svg.hashsalt": "course_pkg", "svg.fonttype": "none"}
SETTINGS = {
    "figure_formats": {"svg"},
    "print_figure_kwargs": {"bbox_inches": "tight", "metadata": {"Date": None}},
    "rc": RC,
}


def set_up_figures() -> None:
    """Make this kernel show figures as SVG; outside of IPython, do nothing.

    matplotlib's inline backend reads the settings before it draws the first figure. After the first figure,
    the settings apply to the next figure.
    """
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    if shell is None:
        return
    shell.config.InlineBackend.update(SETTINGS)
    # On a new machine, matplotlib logs a message about its font cache; a cell must not show this message.
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    config = sys.modules.get("matplotlib_inline.config")
    if config and config.InlineBackend.initialized():
        sys.modules["matplotlib"].rcParams.update(RC)
        for name, value in SETTINGS.items():
            setattr(config.InlineBackend.instance(), name, value)
