"""One case from beginning to end: measured, diagnosed, and what was learned held against the truth."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from fmpy import simulate_fmu
from numpy.typing import NDArray

from pysim.diagnosis import Session, diagnose
from pysim.effects.learned import Law, Term, curve_basis, places
from pysim.types import Dataset, Effect
from pysim.types.answer import Diagnosis, LearnedLaw
from pysim.types.factor import Form
from pysim.workflow.learned import with_laws
from validation.asked import PUMP, Step, steps_of
from validation.batch import Line, serve
from validation.held_out import held_out_rms
from validation.learned.cases import CASES, NOISE, LearnedCase, measure

Array = NDArray[np.float64]

_ALIKE = {"xp": "x", "piston.x": "x", "linkage.s": "x", "xp_t": "v", "piston.v": "v", "spool.u": "s", "u": "s",
          "chamber1.p": "p1", "chamber2.p": "p2", "chamber1.p - chamber2.p": "dp"}  # fmt: skip
# Powers of a mechanism's scale. Angle, spool and pressures stay the same where its lengths are divided by a number and
# its areas and forces multiplied by it, so that no test of these cases tells that number.
_OF_SCALE = {"x": -1, "v": -1, "pistonForce": 1}
_WIDTH = 1.96  # standard deviations on either side, of a band of 95 percent
_PLACES = 101  # of a curve that are looked at


@dataclass(frozen=True)
class Answer:
    """One case, answered and judged. Errors are against the noise-free wave that was not given, over the noise.

    Args:
        case: its name.
        learned: "slot: factor*h(argument)" of each law, in order.
        effects: names of the catalogue's effects beside them.
        formula: of the first law; "" for none.
        place: whether all places are right and none is wrong; of a law that cannot be seen, whether nothing was added.
        named: the same where an effect of the catalogue at a right place counts as a law there.
        variables: whether the laws at right places depend on the right variables; None where that is not asked.
        band: share of what the first curve's argument ran through in the fitted logs, over which its 95 percent band
            holds the true curve; None where the true law is no curve of these variables.
        fitted, again: residual over the noise on the wave that may choose, as the answer states it and of the class.
        exported: largest difference of its FMUs of FMI 2 and 3 from the fitted model, all in FMPy, over the range; None
            where no law was learned.
        before, after: error of the refitted base model and of the last one; None where that cannot be simulated.
        seconds, cpu: of the diagnosis, by the clock and of this process.
        learning: seconds of these, by the clock, that learning took.
        trouble: why there is no answer.
    """

    case: str
    learned: tuple[str, ...] = ()
    effects: tuple[str, ...] = ()
    formula: str = ""
    place: bool = False
    named: bool = False
    variables: bool | None = None
    band: float | None = None
    before: float | None = None
    after: float | None = None
    fitted: float | None = None
    again: float | None = None
    exported: float | None = None
    seconds: float = 0.0
    cpu: float = 0.0
    learning: float = 0.0
    trouble: str = ""

    def __str__(self) -> str:
        if self.trouble:
            return f"{self.case}: {self.trouble}"
        found = ", ".join((*self.learned, *self.effects)) or "nothing"
        errors = " -> ".join("?" if one is None else f"{one:.2f}" for one in (self.before, self.after))
        place = "right" if self.place else "right by an effect's" if self.named else "WRONG"
        marks = f"{place} place, variables {_MARKS[self.variables]}"
        band = "" if self.band is None else f", band {100 * self.band:.0f} %"
        formula = f", {self.formula}" if self.formula else ""
        return f"{self.case}: {found}; {marks}; error {errors}{band}{formula}; {self.seconds:.0f} s"


_MARKS = {True: "right", False: "WRONG", None: "-"}


def read_answer(line: Line) -> Answer:
    """From a line of a batch."""
    given: dict[str, Any] = {name: tuple(value) if isinstance(value, list) else value for name, value in line.items()}
    return Answer(**given)


def line_of(name: str) -> Line:
    """The answer to the case of that name."""
    found: dict[str, Any] = asdict(answer(next(case for case in CASES if case.name == name)))
    return {key: float(f"{value:.6g}") if isinstance(value, float) else value for key, value in found.items()}


def answer(case: LearnedCase, ask: Callable[[Session], Diagnosis] = diagnose) -> Answer:
    """The answer to one case.

    Args:
        ask: a diagnosis.
    """
    measured = measure(case)
    session = PUMP.session(measured.given)
    wall, cpu = time.monotonic(), time.process_time()
    found = ask(session)
    wall, cpu = time.monotonic() - wall, time.process_time() - cpu
    found, effects = PUMP.whole(found), tuple(one.effect for one in found.effects if one.effect.class_name)
    steps = steps_of(found, PUMP)
    first = found.learned[0] if found.learned else None
    return Answer(
        case.name,
        tuple(f"{law.slot}: {str(law.factor) and f'{law.factor}*'}h({law.argument})" for law in found.learned),
        tuple(one.effect.name for one in found.effects),
        first.formula if first else "",
        *_right(case, found.learned, effects),
        None if first is None else band(case, first),
        error(steps[0], measured.unseen),
        error(steps[-1], measured.unseen),
        found.history[-1].validate if found.history else None,
        error(steps[-1], measured.given, "validate"),
        difference(found, steps[-1]) if found.learned else None,
        wall,
        cpu,
        found.seconds.get("learn", 0.0),
    )


def difference(found: Diagnosis, last: Step) -> float:
    """Largest, in FMPy, of the class as FMU of FMI 2 and of FMI 3 from the model that was fitted, over the range.

    The fitted model holds the law as its diagnosis compiled it, with the law's numbers as parameters. All run a second
    after a step of the command, at 1e-12: at 1e-8 the solver's own error is 1e-4 where a plant is nearly unstable.

    Args:
        last: step of the answer, whose parameters all have.
    """
    with TemporaryDirectory(prefix="learned-") as folder:
        effects, variants = with_laws(found, PUMP.variants, Path(folder))
        fitted, laws = _fitted(found)
        runs = [_run(fitted, {**last.values, **laws})]
        for fmi in (2, 3):
            fmu = Path(folder) / f"export{fmi}.fmu"
            variants.write(effects, Path(folder), fmu, fmi=fmi)
            runs.append(_run(fmu, last.values))
    return float(max(np.max(np.abs(run - runs[0])) for run in runs[1:]) / np.ptp(runs[0]))


def _fitted(found: Diagnosis) -> tuple[Path, dict[str, float]]:
    """FMU of the model that was fitted, with a term at each law's place, and the parameters that make them the laws."""
    where = {one.name: one for one in places(PUMP.variants.slots, PUMP.model)}
    terms, values = list[Term](), dict[str, float]()
    for own in found.learned:
        place, factor = where[own.slot], own.factor
        by = place.sides[0].own.index(f"{place.name}.{factor.variable}") if factor.variable else None
        place = replace(place, moved=(by,)) if by is not None and factor.form is Form.HYSTERESIS else place
        law = Law(place, place.arguments.index(own.argument), factor.form, by, factor.number, factor.rate)
        values |= law.settings(own.knots)
        values |= dict(zip(place.coefficients(own.knots.size), own.coefficients.tolist(), strict=True))
        terms.append(Term(place, own.knots.size, bool(law.free)))
    return PUMP.variants.probed([one.effect for one in found.effects if one.effect.class_name], terms).path, values


def _run(fmu: Path, values: Mapping[str, float]) -> Array:
    done = simulate_fmu(
        str(fmu), stop_time=1.0, output_interval=1e-3, relative_tolerance=1e-12, fmi_type="ModelExchange",
        start_values={**values, "alphaCMD": 30.0}, output=["alphaPercent"],
    )  # fmt: skip
    return np.asarray(done["alphaPercent"], dtype=np.float64)


def error(step: Step, data: Dataset, use: str = "test") -> float | None:
    """Root mean square of simulated minus reading, over the noise, of all signals."""
    try:
        sizes = held_out_rms(step.model, data, step.values, use, sensors=step.sensors)
    except Exception:  # whatever stops a run, the model has no error
        return None
    return float(np.sqrt(np.mean([(size / NOISE[name]) ** 2 for name, size in sizes.items()])))


def _right(
    case: LearnedCase, learned: Sequence[LearnedLaw], effects: Sequence[Effect]
) -> tuple[bool, bool, bool | None]:
    """Whether the places are right by laws, or by laws and effects, and the variables of the laws there."""
    at, places = {law.slot for law in learned}, case.kind.places
    if not places:
        nothing = not learned and not effects
        return nothing, nothing, None
    every = at | {effect.slot for effect in effects}
    clean = every <= {slot for some in places for slot in some}
    place, named = (clean and all(own & set(some) for some in places) for own in (at, every))
    asked = [(some, words) for some, words in zip(places, case.kind.variables, strict=False) if words]
    if not asked:
        return place, named, None
    return place, named, all(any(law.slot in some and _fits(law, words) for law in learned) for some, words in asked)


def _fits(law: LearnedLaw, words: Sequence[tuple[str, ...]]) -> bool:
    """Whether each group of words is met, and nothing is beside them."""
    used = {_bare(law, law.argument), *([_bare(law, law.factor.variable)] if law.factor.variable else [])}
    return all(used & set(group) for group in words) and used <= {word for group in words for word in group}


def _bare(law: LearnedLaw, name: str) -> str:
    """A variable as the cases call it."""
    own = name.removeprefix(f"{law.slot}.")
    return _ALIKE.get(own, own)


def band(case: LearnedCase, law: LearnedLaw) -> float | None:
    """Share of the fitted logs' range over which the curve's 95 percent band holds the truth; what is absorbed is free.

    The true curve is taken in the scale of the model's piston, whose area tells it.
    """
    form, curve = case.kind.form, case.kind.curve
    if curve is None or law.slot not in case.kind.places[0]:
        return None
    factor, argument = _bare(law, law.factor.variable), _bare(law, law.argument)
    signed = law.factor.form is Form.SIGN
    if (f"sign({factor})" if signed else factor, argument) != form:
        return None
    true = case.parameters()
    scale = law.parameters.get("A_p", true.A_p) / true.A_p
    size = scale ** (_OF_SCALE.get(law.slot, 0) - (0 if signed else _OF_SCALE.get(factor, 0)))
    along = scale ** -_OF_SCALE.get(argument, 0)
    z = np.linspace(*law.reach, _PLACES)
    basis = curve_basis(z, law.knots)
    deviation = np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", basis, law.covariance, basis), 0))
    wrong = basis @ law.coefficients - size * curve(along * z, case.laws()[0], true)
    free = basis @ law.absorbed if law.absorbed.size else np.zeros((z.size, 0))
    weight = 1 / np.maximum(deviation, 1e-9 * float(np.max(np.abs(law.coefficients), initial=math.ulp(0.0))))
    wrong -= free @ np.linalg.lstsq(free * weight[:, None], wrong * weight, rcond=None)[0]
    return float(np.mean(np.abs(wrong) <= _WIDTH * deviation))


if __name__ == "__main__":
    serve(line_of, sys.argv[1:])
