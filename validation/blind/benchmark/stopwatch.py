"""What answering a case costs, and when it was done."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Protocol


class Compiles(Protocol):
    """A workshop."""

    seconds: float


@dataclass
class Spent:
    """s of wall and processor, once the work is done."""

    wall: float = 0.0
    cpu: float = 0.0


@contextmanager
def timed(shop: Compiles) -> Iterator[Spent]:
    """Time what is done inside; the wall without what the workshop compiles meanwhile."""
    spent = Spent()
    compiled, wall, cpu = shop.seconds, time.monotonic(), time.process_time()
    yield spent
    spent.wall = time.monotonic() - wall - (shop.seconds - compiled)
    spent.cpu = time.process_time() - cpu


def today() -> str:
    """As year-month-day, everywhere the same."""
    return datetime.now(UTC).date().isoformat()
