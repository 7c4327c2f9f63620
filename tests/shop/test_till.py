"""A till counts what was printed, one thing at a time."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import pytest

from course_pkg.errors import PrinterFailed
from course_pkg.shop import OpenTill, Printer


def test_a_new_price_takes_the_place_of_the_old_one() -> None:
    """The sum is that of the newest price of each item, and every one was printed."""
    till = OpenTill(Printer())
    assert [till.put("milk", 120), till.put("bread", 340), till.put("milk", 110)] == [120, 460, 450]
    assert till.total() == 450
    assert till.printer.lines == ["milk 120", "bread 340", "milk 110"]


def test_what_is_not_printed_does_not_count() -> None:
    """A printer without paper says so, and the till goes on when there is some."""
    till = OpenTill(Printer(paper=1))
    till.put("milk", 120)
    with pytest.raises(PrinterFailed, match="out of paper"):
        till.put("bread", 340)
    assert till.total() == 120
    till.printer.paper = 2
    assert till.put("bread", 340) == 460


def test_a_printer_jams_when_it_is_told_two_lines_at_once() -> None:
    """And a till never tells it two."""
    printer, till = Printer(), OpenTill(Printer())  # the till has one of its own
    with ThreadPoolExecutor(8) as pool:
        told = [pool.submit(printer.print, str(number)) for number in range(8)]
        put = [pool.submit(till.put, str(number), 1) for number in range(8)]
        assert any(isinstance(future.exception(20), PrinterFailed) for future in told)
        assert sorted(future.result(20) for future in put) == list(range(1, 9))
