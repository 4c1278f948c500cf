"""The instruments that measure what a fit costs."""

import math
import os
import sys
from collections import Counter

import pytest

from validation.benchmarks import python_share
from validation.benchmarks.__main__ import row
from validation.benchmarks.measurement import Measurement, Timed, in_turn, middle, ratio
from validation.benchmarks.runnable import on_free_cores, watched
from validation.benchmarks.sampler import sampled


def test_a_ratio_is_the_median_of_pairs_and_not_the_ratio_of_medians() -> None:
    pairs = [(Timed(a, 2 * a, 0.0), Timed(b, b, 0.0)) for a, b in ((6.0, 3.0), (1.0, 4.0), (8.0, 2.0))]
    assert ratio(pairs, "cpu") == 2.0
    assert ratio(pairs, "wall") == 4.0
    assert middle([one for one, _ in pairs], "cpu") == 6.0


def test_both_are_called_in_turn() -> None:
    calls: list[str] = []
    assert len(in_turn(lambda: calls.append("a"), lambda: calls.append("b"), 2)) == 2
    assert calls == ["a", "b", "a", "b"]


def test_files_are_sorted_into_parts() -> None:
    files = {
        "/usr/lib/libpython3.11.so.1.0": 1,
        "/x/site-packages/numpy/_core/_multiarray_umath.cpython-311-x86_64-linux-gnu.so": 2,
        "/x/site-packages/numpy.libs/libscipy_openblas64_-ff651d7f.so": 4,
        "/x/site-packages/numpy/linalg/_umath_linalg.cpython-311-x86_64-linux-gnu.so": 8,
        "/cache/fmu/0123/binaries/linux64/Pump.so": 16,
        "generated code": 32,
        "/lib/x86_64-linux-gnu/libm.so.6": 64,
        "/lib/x86_64-linux-gnu/libc.so.6": 128,
        "/usr/bin/python3.11": 256,
    }
    expected = {"Python": 1 + 2 + 128 + 256, "linear algebra": 4 + 8, "simulation": 16 + 32 + 64}
    assert python_share.by_part(files) == Counter(expected)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the sampler reads /proc")
def test_a_loop_in_python_counts_as_python() -> None:
    parts = python_share.by_part(sampled(lambda: sum(k * k for k in range(5_000_000))))
    assert parts["Python"] > 0.95 * parts.total() > 0


def test_a_row_shows_value_and_aim_and_why_something_was_skipped() -> None:
    assert row("a", Measurement("ratio", 0.123456, 0.5)).split() == ["a", "0.123", "0.5", "ratio"]
    words = row("a", Measurement("ratio", math.nan, 0.5, skipped="no Dask"))
    assert "skipped" in words
    assert "no Dask" in words


def test_time_on_free_cores_is_that_of_threads_that_could_run_at_a_time() -> None:
    assert on_free_cores(cpu=0.6, waited=0.0, interval=1.0) == 0.6  # one thread, alone
    assert on_free_cores(cpu=0.5, waited=0.5, interval=1.0) == 0.5  # one thread, which shared its core
    assert on_free_cores(cpu=2.0, waited=0.0, interval=1.0) == 1.0  # two threads, alone
    assert on_free_cores(cpu=1.0, waited=1.0, interval=1.0) == 0.5  # two threads that had one core for both
    assert on_free_cores(cpu=1.0, waited=3.0, interval=1.0) == 0.5  # four threads have two cores at most


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the watcher reads /proc")
def test_one_thread_takes_as_long_on_free_cores_as_it_computes() -> None:
    with watched(os.getpid()) as seen:
        sum(k * k for k in range(3_000_000))
    assert 0.8 * seen.cpu < seen.free <= seen.cpu  # two threads would give a half; waits are counted a little late
