"""Terms at inputs and outputs of a model that stays shut: a plant whose actuator or sensor is bent in a known way."""

from collections.abc import Callable

import numpy as np
import pytest

from fmu_build import build
from pysim.diagnose import subject
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.outside import outside
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import rulers
from pysim.diagnose.subject import extended
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Dataset, Experiment, Missing, Model, Signal
from tests.foreign import made_foreign
from tests.pysim.diagnose.bench import REST
from tests.pysim.diagnose.toy import BENCH, library

Bent = Callable[[np.ndarray], np.ndarray]
TRUTH = {"m": 1.05, "d": 0.75, "k": 21.0}
BOUNDS = {"m": (0.5, 5.0), "d": (0.0, 10.0), "k": (1.0, 100.0)}


def straight(z: np.ndarray) -> np.ndarray:
    return z


def dead_band(z: np.ndarray) -> np.ndarray:
    return z - np.clip(z, -0.4, 0.4)


def threshold(z: np.ndarray) -> np.ndarray:
    return z - np.clip(z, -0.05, 0.05)


@pytest.fixture(scope="module")
def mass(tmp_path_factory: pytest.TempPathFactory) -> Model:
    folder = tmp_path_factory.mktemp("outside")
    return read_model(made_foreign(build("Toy.Mass", libraries=[library()]), folder / "mass.fmu"))


def measured(mass: Model, seed: int, actuator: Bent = straight, sensor: Bent = straight) -> Dataset:
    """One wave of the plant: what is logged is the command ahead of the actuator and the reading behind the sensor."""
    rng = np.random.default_rng(seed)
    knots, times, fine = np.arange(0, 20.01, 0.4), np.arange(0, 20, 0.02), np.arange(0, 20.001, 0.002)
    command = Signal.through(knots, np.append(0.0, 6 * rng.standard_normal(knots.size - 1)))
    force = Signal.through(fine, actuator(command.value(fine)))
    run = Experiment(times, ("x",), {"F": force}, TRUTH)
    x = sensor(simulate(mass, run, solver=Rodas(rtol=1e-8, atol=1e-8))["x"])
    return BENCH.dataset(BENCH.log(times, command, x, rng))


def seen(mass: Model, data: Dataset) -> tuple[Missing, ...]:
    given = subject(mass, data, (), None, free=tuple(BOUNDS), bounds=BOUNDS, rest=REST)
    ruler, _ = rulers(given.targets)
    what = extended(given, ())
    return outside(
        ruler, Fitted(what, refit(ruler, what, ruler.evaluation(what, what.space.to_search(what.space.start))))
    )


def distance(found: Missing, truth: Bent) -> float:
    """Largest distance of the shape from truth(z) - z, over the term's own size, with the best scale and straight line.

    Refitting m, d and k together scales the answer, and so does a straight line at the input or the output. Compared
    where there are samples enough: over the inner 60 percent of the range.
    """
    inner = np.abs(found.shape.argument) < 0.6 * np.abs(found.shape.argument).max()
    z, value = found.shape.argument[inner], found.shape.value[inner]
    columns = np.column_stack([truth(z) - z, z])
    amounts = np.linalg.lstsq(columns, value, rcond=None)[0]
    assert 0.8 < amounts[0] < 1.2
    return float(np.abs(value - columns @ amounts).max() / np.ptp(columns[:, 0]))


def test_a_dead_band_of_the_actuator_is_seen_at_the_input(mass: Model) -> None:
    first, *_ = found = seen(mass, measured(mass, 1, actuator=dead_band))
    assert sorted(one.slot for one in found) == ["F", "x"]  # each place once, and nothing inside
    assert (first.slot, first.depends_on) == ("F", "F")
    assert (first.shape.argument_unit, first.shape.unit) == ("N", "N")
    assert first.share > 0.9
    assert distance(first, dead_band) < 0.15  # a corner between two of the eleven knots is cut


def test_a_bent_sensor_is_seen_at_the_output(mass: Model) -> None:
    first, *_ = seen(mass, measured(mass, 2, sensor=threshold))
    assert (first.slot, first.depends_on) == ("x", "x")
    assert (first.shape.argument_unit, first.shape.unit) == ("m", "m")
    assert first.share > 0.9
    assert distance(first, threshold) < 0.15


def test_where_nothing_is_missing_no_term_takes_much(mass: Model) -> None:
    assert all(one.share < 0.3 for one in seen(mass, measured(mass, 4)))
