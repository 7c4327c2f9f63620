"""Choices and plots in a real JupyterLab."""

from __future__ import annotations

from playwright.sync_api import Page, expect

from tests.browser.jupyter import Lab, panel, picture, run_all, running_notebook

IMPORT = "from course_pkg import Plot, choose, predictions"
CHOOSE = """
choose("03.lab", "Which fits each case?", options=["a topic", "a service", "either"], cases=[
    ("Joint values, 100 times a second", "a topic", "A lost one is replaced at once."),
    ("One picture, on demand", "a service", "Somebody waits for it."),
])
"""
PLOT = 'Plot({"topic": [(0, 1.5), (1, 2.5)]}, x="time (s)", y="delay (ms)", title="How late?")'


def test_choices_are_made_compared_and_kept(lab: Lab, page: Page) -> None:
    """By keyboard: every case, then the reasons; a new run has them still, and the first time counts."""
    with running_notebook(page, lab, "choose", IMPORT, CHOOSE, 'predictions("03")', PLOT):
        choices = panel(page, "Choices")
        first = choices.get_by_role("radiogroup", name="Joint values")
        second = choices.get_by_role("radiogroup", name="One picture")
        choices.get_by_role("button", name="Show the reasons").click()
        expect(choices.get_by_text("Decide every case first: 2 of 2 are still open.")).to_be_visible()
        expect(first.get_by_label("a topic")).to_be_focused()
        page.keyboard.press("Space")
        page.keyboard.press("Tab")
        page.keyboard.press("ArrowDown")
        expect(second.get_by_label("a service")).to_be_checked()
        page.keyboard.press("ArrowDown")
        expect(choices.get_by_text("All decided.")).to_be_visible()
        page.keyboard.press("Tab")
        expect(choices.get_by_role("button", name="Show the reasons")).to_be_focused()
        page.keyboard.press("Enter")
        expect(choices.get_by_text("Does not fit. Better: a service.")).to_be_visible()
        expect(choices.get_by_text("1 of 2 fit.")).to_be_visible()
        picture(choices, "choices")
        run_all(page)
        expect(panel(page, "Choices").get_by_text("Does not fit. Better: a service.")).to_be_visible()
        expect(panel(page, "Predictions").get_by_text("1 of 2 fit", exact=True)).to_be_visible()
        choices = panel(page, "Choices")
        choices.get_by_role("button", name="Choose again").click()
        for name, option in {"Joint values": "a topic", "One picture": "a service"}.items():
            choices.get_by_role("radiogroup", name=name).get_by_label(option).check()
        choices.get_by_role("button", name="Show the reasons").click()
        said = "2 of 2 fit. 1 of 2 fitted the first time, and that is what counts."
        expect(choices.get_by_text(said)).to_be_visible()
        expect(panel(page, "Plot: How late?").locator("polyline")).to_have_count(1)
        picture(page, "choices-page")
