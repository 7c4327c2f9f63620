"""What the timeline costs in a browser: drawing 2,000 events for the first time, and moving along them.

usage: ./course run python tests/bench/timeline.py
`./course test` installs the browser that it needs. Moving is measured with all events in view and with an
eighth of them; each frame waits for the browser to have painted the one before.
"""

from __future__ import annotations

import json
import shutil
import statistics
import sys
import tempfile
from pathlib import Path

from lab import FLAGS, ROOT
from playwright.sync_api import Page, sync_playwright

from course_pkg.graph.events import (
    CALLBACK,
    CONNECT,
    HANDLER,
    LOOKUP,
    PUBLISH,
    REQUEST,
    RESPONSE,
    WAIT,
    Event,
)
from course_pkg.graph.recording import Recording
from course_pkg.panels.assets import module, sheet
from course_pkg.panels.timeline.model import state

EVENTS, LENGTH = 2000, 10.0  # s
DRAW_BAR, PAN_BAR = 500.0, 30.0  # ms; frames per second
REPEATS, WATCH = 9, 2000  # ms of moving
PANELS = ROOT / "course_pkg" / "panels"
DRAW = """async (state) => {
    const url = URL.createObjectURL(new Blob([state._esm], {type: "text/javascript"}))
    const {render} = (await import(url)).default
    const el = document.getElementById("main")
    const model = {get: name => state[name], on() {}, send() {}, set() {}, save_changes() {}}
    const frame = () => new Promise(requestAnimationFrame)
    await frame()
    const start = performance.now()
    const end = render({model, el})
    await frame()
    await frame()
    const took = performance.now() - start
    window.again = () => { end(); el.replaceChildren() }
    return took
}"""
PAN = """async (watch) => {
    const canvas = document.querySelector("canvas.ros-body")
    const box = canvas.getBoundingClientRect()
    const send = (kind, x) => canvas.dispatchEvent(new PointerEvent(kind,
        {clientX: box.left + x, clientY: box.top + 3, bubbles: true, pointerId: 1, button: 0}))
    canvas.setPointerCapture = () => {}
    send("pointerdown", 400)
    const frames = []
    const start = performance.now()
    let last = start
    while (last - start < watch) {
        send("pointermove", 400 + 200 * Math.sin((last - start) / 300))
        await new Promise(requestAnimationFrame)
        const now = performance.now()
        frames.push(now - last)
        last = now
    }
    send("pointerup", 400)
    return frames
}"""


def main() -> int:
    """Print the figures; fail when one misses its bar."""
    files = {"_esm": module(PANELS / "timeline/timeline.js"), "recorded": state(recording())}
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        page = browser.new_page(viewport={"width": 1000, "height": 900})
        style = sheet(PANELS / "look.css", PANELS / "timeline/timeline.css")
        host = Path(folder, "page.html")
        host.write_text(f"<!doctype html><style>{style}</style><main id=main></main>")
        page.goto(host.as_uri())
        drawn = [first_drawing(page, files) for _ in range(REPEATS)]
        rates = {"all": moving(page)}
        for _ in range(3):
            page.get_by_role("button", name="Zoom in").click()
        rates["an eighth"] = moving(page)
        browser.close()
    size = len(json.dumps(files["recorded"])) / 1000
    middle = statistics.median(drawn)
    print(f"drawing {EVENTS} events: median {middle:.0f} ms, bar {DRAW_BAR:.0f} ms; state {size:.0f} kB")
    for label, rate in rates.items():
        print(f"moving with {label} in view: {rate:.0f} frames a second, bar {PAN_BAR:.0f}")
    return int(middle > DRAW_BAR or min(rates.values()) < PAN_BAR)


def first_drawing(page: Page, files: dict[str, object]) -> float:
    """Return how long it takes from the beginning to the first picture on the page (ms)."""
    page.evaluate("window.again?.()")
    return float(page.evaluate(DRAW, files))


def moving(page: Page) -> float:
    """Return how many frames a second are drawn while the timeline is dragged back and forth."""
    frames = page.evaluate(PAN, WATCH)
    slow = sorted(frames)[int(0.95 * len(frames))]
    print(f"  frames: median {statistics.median(frames):.1f} ms, 95 % within {slow:.1f} ms")
    return 1000 * len(frames) / sum(frames)


def recording() -> Recording:
    """Make up a recording: a stream at 80 Hz and calls of 0.1 s beside it."""
    events: list[Event] = []
    for number in range(int(80 * LENGTH)):
        at, key = number / 80, f"message {number}"
        events.append(Event(PUBLISH, "/robot", "/joints", at, at + 1e-4, "/simulator", key, "MainThread"))
        events.append(
            Event(CALLBACK, "/simulator", "/joints", at + 3e-4, at + 6e-4, "/robot", key, "/joints")
        )
    number = 0
    while len(events) < EVENTS:
        events += call(number, 0.02 + 0.145 * number)
        number += 1
    return Recording(events=tuple(sorted(events[:EVENTS], key=lambda event: event.start)), length=LENGTH)


def call(number: int, at: float) -> list[Event]:
    """Make up a call."""
    key, who, whom = f"call {number}", "/customer", "/cashier"
    parts = (
        (LOOKUP, 0, 1e-3),
        (CONNECT, 1e-3, 2e-3),
        (REQUEST, 2e-3, 2.1e-3),
        (WAIT, 2.1e-3, 0.1),
        (RESPONSE, 0.1, 0.1),
    )
    mine = [
        Event(kind, who, "/detect", at + start, at + end, whom, key, "MainThread")
        for kind, start, end in parts
    ]
    return [*mine, Event(HANDLER, whom, "/detect", at + 2.2e-3, at + 0.0999, who, key, f"Thread-{number}")]


if __name__ == "__main__":
    sys.exit(main())
