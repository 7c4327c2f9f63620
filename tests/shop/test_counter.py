"""Tests of the times at which customers come and leave."""

from __future__ import annotations

import math

import pytest

from course_pkg.errors import FieldError
from course_pkg.shop import Counter


def test_customers_come_and_go() -> None:
    """A customer is present from the time of arrival until the time of leaving."""
    counter = Counter()
    visits = counter.let_in(100.0, [1.0, 1.5], stay=2.0)
    assert [(visit.number, visit.comes, visit.goes) for visit in visits] == [
        (1, 101.0, 103.0),
        (2, 101.5, 103.5),
    ]
    there = {now: counter.there(now) for now in (100.0, 101.0, 101.5, 102.9, 103.0, 103.5)}
    assert there == {100.0: (), 101.0: (1,), 101.5: (1, 2), 102.9: (1, 2), 103.0: (2,), 103.5: ()}


def test_numbers_follow_the_order_of_coming() -> None:
    """The customer who comes first has the lowest number."""
    visits = Counter(7).let_in(0.0, [3.0, 1.0, 2.0], stay=1.0)
    assert [(visit.number, visit.comes) for visit in visits] == [(7, 1.0), (8, 2.0), (9, 3.0)]


def test_a_second_call_removes_future_customers() -> None:
    """A second let_in() call removes customers who have not come yet, but no customers at the counter."""
    counter = Counter()
    counter.let_in(0.0, [0.0, 5.0], stay=10.0)
    visits = counter.let_in(1.0, [1.0], stay=1.0)
    assert [visit.number for visit in visits] == [3]
    assert [counter.there(now) for now in (1.0, 2.0, 5.0, 10.0)] == [(1,), (1, 3), (1,), ()]


def test_an_empty_list_of_customers_is_accepted() -> None:
    """let_in() with an empty list removes all customers who have not come yet."""
    counter = Counter()
    counter.let_in(0.0, [1.0], stay=1.0)
    assert counter.let_in(0.5, [], stay=0.0) == []
    assert counter.next_change(0.5) == math.inf


def test_the_next_change_is_the_next_arrival_or_departure() -> None:
    """next_change() returns the time of the next arrival or departure, or infinity if there is none."""
    counter = Counter()
    counter.let_in(0.0, [1.0, 1.5], stay=1.0)
    changes = [0.0]
    while (change := counter.next_change(changes[-1])) < math.inf:
        changes.append(change)
    assert changes == [0.0, 1.0, 1.5, 2.0, 2.5]


@pytest.mark.parametrize("wrong", [-0.1, math.nan, math.inf, 1e9])
def test_an_impossible_time_is_refused(wrong: float) -> None:
    """If a time is impossible, the error message contains its field, and the planned visits do not change."""
    counter = Counter()
    counter.let_in(0.0, [1.0], stay=1.0)
    with pytest.raises(FieldError, match=r"after\[1\]"):
        counter.let_in(0.0, [0.0, wrong], stay=1.0)
    with pytest.raises(FieldError, match="stay"):
        counter.let_in(0.0, [0.0], stay=wrong)
    assert (counter.there(0.0), counter.there(1.5), counter.number) == ((), (1,), 2)


def test_too_many_customers_are_refused() -> None:
    """If there are too many customers, the error message contains their number and the maximum."""
    with pytest.raises(FieldError, match="1001 customers are too many; expected at most 1000"):
        Counter().let_in(0.0, [0.0] * 1001, stay=1.0)
