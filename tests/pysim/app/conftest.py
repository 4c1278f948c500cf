"""One browser for the tests of a file."""

from collections.abc import Iterator
from typing import Any

import pytest

from tests.pysim.app.browser import browser


@pytest.fixture(scope="module")
def shown() -> Iterator[Any]:
    with browser() as found:
        yield found
