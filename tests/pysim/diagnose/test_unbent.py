import numpy as np
import pytest

from pysim.diagnose.contenders import Contender
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.residuals import Ruler, rulers
from pysim.diagnose.subject import Extended, extended
from pysim.diagnose.unbent import best_of, unbent
from tests.pysim.diagnose.toy import CATALOGUE, measured, toy_subject

FRICTION = CATALOGUE["toy.friction"]


def rubbing() -> tuple[Contender, Fitted]:
    """Friction of 0.4 N in the measurements, and the base model at its own parameters."""
    own = toy_subject(measured(1, FRICTION.name, F_c=0.4))
    ruler, _ = rulers(own.targets)
    plain = extended(own, [])
    nominal = Fitted(plain, ruler.evaluation(plain, plain.space.to_search(plain.space.start)))
    return Contender(FRICTION, extended(own, [FRICTION]), ruler), nominal


def at(ruler: Ruler, what: Extended, **values: float) -> Fitted:
    bent = [
        values.get(key.rpartition(".")[2], start) for key, start in zip(what.space.keys, what.space.start, strict=True)
    ]
    return Fitted(what, ruler.evaluation(what, what.space.to_search(np.array(bent))))


def strength(one: Contender, x: np.ndarray) -> float:
    return one.what.space.values(x)[f"{one.what.places[FRICTION.name]}.F_c"]


@pytest.mark.parametrize("found", [0.1, 2.4])
def test_what_was_found_beside_bent_parameters_is_found_again_beside_the_models_own(found: float) -> None:
    one, nominal = rubbing()
    bent = at(one.ruler, one.what, m=4.0, d=5.0, k=2.0, F_c=found)
    end = unbent(one, bent, nominal)
    assert end is not None
    assert end[0].cost < 1.2 * one.ruler.freedom < bent.point.cost
    assert strength(one, end[0].x) == pytest.approx(0.4, rel=0.05)


def test_the_strength_that_fits_best_begins(monkeypatch: pytest.MonkeyPatch) -> None:
    one, nominal = rubbing()
    begun = []

    def refit_from(ruler: Ruler, what: Extended, first, **_):  # type: ignore[no-untyped-def]
        begun.append(strength(one, first.x))
        return first, first.x

    monkeypatch.setattr("pysim.diagnose.unbent.refit_from", refit_from)
    assert best_of(one, nominal, [{"F_c": value} for value in (0.05, 0.5, 5.0)]) is not None
    assert begun == [pytest.approx(0.5)]
