"""Plants of the known answers: sessions with logs of them in memory, and models with effects refitted to these."""

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

from pysim.diagnosis.candidate import Models, Values
from pysim.diagnosis.refit import FinalFit, begin, converged
from pysim.diagnosis.session import Session, session
from pysim.effects import read_catalogue
from pysim.identify.greybox import Simulation, Threads
from pysim.types import Dataset, Effect, MeasuredRecord, MeasuredSignal, Record
from pysim.workflow.variants import Variants
from tests.known_answers.case import Case, Logs
from tests.known_answers.plants import PLANTS

FINE = Simulation(workers=Threads(1)).searching()
# A limit of the mass: what holds it back beyond a place.
STOPS = """
package Stops
  model Ends "End stops"
    extends Mass.PartialForce;
    parameter Real inverse_x_m(unit="1/m", min=0, max=200, nominal=5) = 0 "0 = off"
      annotation(__HydraulicTestBench(inverse="x_m", limits="x"));
  equation
    f = noEvent(if x*inverse_x_m > 1 then -500*(x - 1/inverse_x_m)
      elseif x*inverse_x_m < -1 then -500*(x + 1/inverse_x_m) else 0);
    annotation(__HydraulicTestBench(effect="stops.ends", slot="force"));
  end Ends;
end Stops;
"""


@cache
def variants(plant: str) -> Variants:
    """Builds models with effects, each once."""
    return Variants(PLANTS[plant].model, (PLANTS[plant].library,))


@cache
def catalogue(plant: str) -> Mapping[str, Effect]:
    """Effects of the plant's library by name."""
    return {effect.name: effect for effect in read_catalogue(PLANTS[plant].library)}


def measured(
    plant: str,
    effects: Mapping[str, Mapping[str, float]] | None = None,
    parameters: Mapping[str, float] | None = None,
    **logs: object,
) -> Dataset:
    """Logs of a plant with these effects and parameters in force, integrated by SciPy.

    Args:
        logs: as `tests.known_answers.case.Logs` has them.
    """
    case = Case(plant, "", PLANTS[plant], parameters or {}, effects or {}, Logs(**logs), {})  # type: ignore[arg-type]
    own, records = case.plant, []
    names, units = (own.command, *own.sensors), (own.unit, *(sensor.unit for sensor in own.sensors.values()))
    for use in ("fit", "validate"):
        for seed in getattr(case.logs, use):
            time, values = case.logged(seed)
            records.append(MeasuredRecord(f"{use}-{seed}.txt", "stochastic", use, Record(time, values, names, units)))
    signals = [MeasuredSignal(own.command, "input", own.unit, own.command, own.command)]
    for name, sensor in own.sensors.items():
        noise = case.logs.stated * case.logs.louder * sensor.noise or None
        signals.append(MeasuredSignal(name, "output", sensor.unit, name, name, noise=noise))
    return Dataset(plant, "of a known answer", "plant", tuple(signals), tuple(records))


def stopped(folder: Path) -> tuple[Dataset, Models]:
    """Logs of a mass that has no ends, and the model that may have some; the library is written into a folder."""
    data = measured("mass", length=4.0)
    return data, Models(with_library(folder / "Stops.mo", STOPS, data))


def with_library(file: Path, text: str, data: Dataset) -> Session:
    """The mass as designed beside data, with the effects of a library that is written into a file."""
    file.write_text(text, encoding="utf-8")
    own = Variants(PLANTS["mass"].model, (PLANTS["mass"].library, file))
    return session(own.build(())[0], data, read_catalogue(file), own.build, initial="rest", workers=1)


def given(plant: str, data: Dataset, names: Sequence[str] | None = None, *, initial: str = "rest") -> Session:
    """The model as designed beside data, with effects of its library: all where no names are given."""
    known, own = catalogue(plant), variants(plant)
    chosen = list(known.values()) if names is None else [known[name] for name in names]
    return session(
        own.build(())[0], data, chosen, own.build, slots=own.slots, initial=initial, workers=1, build_law=own.probed
    )


def refitted(models: Models, *names: str, values: Values | None = None, simulation: Simulation = FINE) -> FinalFit:
    """The model with these effects, refitted from these values, or where its parameters start."""
    effects = [effect for effect in models.session.catalogue if effect.name in names]
    return converged(begin(models.of(effects), values or {}, simulation))
