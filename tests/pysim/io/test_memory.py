"""A bound on memory: what goes beyond fails there, and nothing stays of the bound."""

import sys

import numpy as np
import pytest

from pysim.io.memory import memory_bound

MORE = 50_000_000


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux bounds the memory of a process")
def test_what_goes_beyond_fails_and_the_bound_ends_with_the_block() -> None:
    with pytest.raises(MemoryError), memory_bound(MORE):
        np.ones(MORE // 4)  # twice as many bytes
    assert np.ones(MORE // 4).size == MORE // 4


def test_what_stays_within_is_there() -> None:
    with memory_bound(MORE):
        found = np.ones(MORE // 16)
    assert found.sum() == MORE // 16
