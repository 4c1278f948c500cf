"""When rows are logged, and how their times are told."""

import numpy as np
import pytest

from pysim.bench import THESIS_LOGGER, Logger
from pysim.types import BadInput


def random() -> np.random.Generator:
    return np.random.default_rng(5)


def test_the_limits_of_the_thesis() -> None:
    assert THESIS_LOGGER.rate(1) == pytest.approx(250.0)
    assert THESIS_LOGGER.rate(4) == pytest.approx(70.0)
    intervals = [1 / THESIS_LOGGER.rate(count) for count in (1, 2, 3, 4, 5)]
    np.testing.assert_allclose(np.diff(intervals), (1 / 70 - 1 / 250) / 3)  # evenly, and on beyond four


def test_a_single_rate_holds_for_any_number() -> None:
    assert [Logger(((1, 500.0),)).rate(count) for count in (1, 7)] == [500.0, 500.0]


def test_instants_run_from_start_to_end() -> None:
    instants = Logger(((1, 250.0),)).instants(2.0, 3.2, 1, random())
    np.testing.assert_allclose(instants, 2.0 + 0.004 * np.arange(301), atol=1e-12)
    assert Logger(((1, 70.0),)).instants(0.0, 1.0, 1, random()).size == 71
    assert Logger(((1, 70.0),)).instants(0.0, 0.999, 1, random()).size == 70


def test_jitter_has_its_size_and_keeps_the_order() -> None:
    even = Logger(((1, 250.0),)).instants(0.0, 100.0, 1, random())
    away = Logger(((1, 250.0),), jitter=2e-4).instants(0.0, 100.0, 1, random()) - even
    assert away.std() == pytest.approx(2e-4, rel=0.03)
    wild = Logger(((1, 250.0),), jitter=3e-3).instants(0.0, 100.0, 1, random())
    assert np.diff(wild).min() > 0
    assert wild[0] == 0.0


def test_stamps_are_ticks_that_never_repeat() -> None:
    logger = Logger(((1, 250.0),), jitter=1e-3, tick=3e-3)
    instants = logger.instants(1.0, 3.0, 1, random())
    stamps = logger.stamps(instants)
    np.testing.assert_allclose(stamps / 3e-3, np.round(stamps / 3e-3), atol=1e-9)
    assert np.diff(stamps).min() > 2.9e-3
    np.testing.assert_array_equal(Logger(((1, 250.0),)).stamps(instants), instants)


def test_a_stamp_is_the_nearest_tick() -> None:
    stamps = Logger(((1, 100.0),), tick=3e-3).stamps(np.array([0.0014, 0.0046, 0.0104]))
    np.testing.assert_allclose(stamps, [0.0, 0.006, 0.009], atol=1e-12)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"rates": ()}, "name at least one number"),
        ({"rates": ((4, 70.0), (1, 250.0))}, "increasing from 1"),
        ({"rates": ((0, 70.0),)}, "increasing from 1"),
        ({"rates": ((1, 0.0),)}, "0 Hz for 1 signals"),
        ({"rates": ((1, 250.0),), "jitter": 0.004}, "jitter is 0.004 s"),
        ({"rates": ((1, 250.0),), "tick": -1.0}, "tick is -1 s"),
    ],
)
def test_refuses_settings_that_make_no_sense(settings: dict[str, object], words: str) -> None:
    with pytest.raises(BadInput, match=words):
        Logger(**settings)  # type: ignore[arg-type]


def test_a_log_that_fits_nowhere_is_refused() -> None:
    random = np.random.default_rng(1)
    for end in (1e40, np.inf):
        with pytest.raises(BadInput, match="shorter, or log more slowly"):
            Logger(((1, 250.0),)).instants(0.0, end, 1, random)
