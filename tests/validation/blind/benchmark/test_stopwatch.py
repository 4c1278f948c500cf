"""Compiling does not count, and a day is written as everywhere."""

import re
import time
from types import SimpleNamespace

from validation.blind.benchmark.stopwatch import timed, today


def test_what_is_compiled_meanwhile_is_not_counted() -> None:
    shop = SimpleNamespace(seconds=3.0)
    with timed(shop) as spent:
        time.sleep(0.05)
        shop.seconds += 100.0
    assert spent.wall < 0.0
    with timed(shop) as spent:
        time.sleep(0.05)
    assert spent.wall >= 0.05
    assert spent.cpu >= 0.0


def test_today() -> None:
    assert re.fullmatch(r"\d{4}-\d\d-\d\d", today())
