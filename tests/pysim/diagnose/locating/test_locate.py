"""Terms that are missing on purpose are found where they are, with their shape, by a method that knows none of them."""

from collections.abc import Sequence
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pytest

from fmu_build import build
from pysim.diagnose import subject
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.laws import Law, Term, wrapped
from pysim.diagnose.locating.locate import locate
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import rulers
from pysim.diagnose.subject import extended
from pysim.effects import slots
from pysim.io import read_model
from pysim.types import Dataset, Effect, Missing, Model
from tests.pysim.diagnose.toy import CATALOGUE, base, build_variant, library, measured


def probed(effects: Sequence[Effect], law: Term) -> Model:
    """As the command line does it."""
    assert not effects
    source = Path(mkdtemp(prefix="toy-")) / "Located.mo"
    source.write_text(wrapped("Toy.Mass", law, "Located"))
    return read_model(build("Located", libraries=[library(), source], probes=law.probes))


def located(
    dataset: Dataset, *, with_slots: bool = True, names: Sequence[str] = (), open_: bool = False
) -> tuple[Missing, ...]:
    """The class is at hand for effects where `open_`."""
    given = subject(base(), dataset, [CATALOGUE[name] for name in names], build_variant if open_ else None)
    ruler, _ = rulers(given.targets)
    what = extended(given, ())
    first = ruler.evaluation(what, what.space.to_search(what.space.start))
    current = Fitted(what, refit(ruler, what, first, rounds=5))
    own = slots("Toy.Mass", [library()]) if with_slots else ()
    return locate(given, ruler, current, slots=own, probed=probed)


@cache
def rubbing() -> tuple[Missing, ...]:
    return located(measured(1, "toy.friction", F_c=0.4), names=("toy.friction",))


def covered(found: Missing, truth: np.ndarray) -> float:
    """Share of the range in which the band holds the true term, whatever amount of what is absorbed is added."""
    shape = found.shape
    rest = truth - shape.value
    if shape.absorbed.size:
        weights = 1 / (shape.high - shape.low)
        fit = np.linalg.lstsq(shape.absorbed * weights[:, None], rest * weights, rcond=None)[0]
        rest = rest - shape.absorbed @ fit
    return float(np.mean(np.abs(rest) <= 0.5 * (shape.high - shape.low)))


def test_dry_friction_is_a_force_over_velocity() -> None:
    found = rubbing()[0]
    assert (found.slot, found.depends_on) == ("force", "force.v")
    assert found.share > 0.95
    assert (found.shape.argument_unit, found.shape.unit) == ("m/s", "N")
    assert "tanh(force.v" in found.formula or "sign(force.v)" in found.formula


def test_the_band_covers_the_true_friction() -> None:
    found = rubbing()[0]
    assert covered(found, -0.4 * np.tanh(found.shape.argument / 0.02)) > 0.9
    width = found.shape.high - found.shape.low
    assert np.median(width) < 0.1  # a band that says something
    assert np.max(width) < 0.8  # even where the force jumps from one side to the other


def test_the_damping_that_refitting_absorbs_is_told() -> None:
    shape = rubbing()[0].shape
    assert shape.absorbed.shape[1] == 1
    slope = np.gradient(shape.absorbed[:, 0], shape.argument)
    np.testing.assert_allclose(slope, slope[0], rtol=1e-6)


def test_a_term_that_an_effect_points_at_is_still_estimated_from_the_measurements() -> None:
    found = located(measured(1, "toy.friction", F_c=0.4), names=("toy.friction", "toy.hardening"), open_=True)[0]
    assert (found.slot, found.depends_on) == ("force", "force.v")
    assert found.share > 0.95
    assert covered(found, -0.4 * np.tanh(found.shape.argument / 0.02)) > 0.9
    assert found.shape.absorbed.shape[1] == 1  # a law with one number has no slope that refitting takes


@pytest.mark.slow
def test_without_slots_the_states_equations_are_looked_at() -> None:
    found = located(measured(1, "toy.friction", F_c=0.4), with_slots=False)
    assert (found[0].slot, found[0].depends_on) == ("der(v)", "v")
    assert found[0].shape.unit == "m/s2"
    assert found[0].share > 0.95


def test_of_a_model_without_source_inputs_and_outputs_are_looked_at() -> None:
    given = subject(base(), measured(1), [], None)
    ruler, _ = rulers(given.targets)
    what = extended(given, ())
    current = Fitted(what, ruler.evaluation(what, what.space.to_search(what.space.start)))
    assert {missing.slot for missing in locate(given, ruler, current)} <= {"F", "x", "v"}


@pytest.mark.parametrize("effects", [(), (CATALOGUE["toy.friction"],)])
def test_a_term_at_zero_leaves_the_model_as_it_is(effects: Sequence[Effect]) -> None:
    law = next(law for law in _laws() if law.argument == "force.v")
    model = probed((), law)
    assert {"missing_c1", "missing_k1", "missing_unit"} <= {v.name for v in model.variables}
    assert model.abilities.states == base().abilities.states


def _laws() -> tuple[Law, ...]:
    from pysim.diagnose.locating.laws import slot_laws

    return slot_laws(slots("Toy.Mass", [library()]), base())
