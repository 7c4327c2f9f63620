"""Tests of the printer of the shop."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import pytest

from course_pkg.errors import PrinterFailed
from course_pkg.shop import Printer


def test_a_printer_without_paper_prints_nothing() -> None:
    """Without paper, `print` raises PrinterFailed. When there is paper again, `print` works again."""
    printer = Printer(paper=1)
    printer.print("milk 120")
    with pytest.raises(PrinterFailed, match="out of paper"):
        printer.print("bread 340")
    assert printer.lines == ["milk 120"]
    printer.paper = 2
    printer.print("bread 340")
    assert printer.lines == ["milk 120", "bread 340"]


def test_a_printer_jams_when_two_lines_come_at_once() -> None:
    """If several threads print at the same time, `lines` contains only the lines of successful calls."""
    printer = Printer()
    with ThreadPoolExecutor(8) as pool:
        futures = [pool.submit(printer.print, str(number)) for number in range(8)]
        errors = [future.exception(20) for future in futures]
    assert any(isinstance(error, PrinterFailed) for error in errors)
    assert sorted(printer.lines) == sorted(str(n) for n, error in enumerate(errors) if error is None)
