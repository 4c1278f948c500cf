"""A test plan from a TOML file, or one that comes with the package."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from pysim.bench.bench_tests import BenchTest, ChirpTest, MultisineTest, SteppedSines, StepTest, WaveTest
from pysim.bench.logger import Logger
from pysim.bench.plan import Plan
from pysim.bench.sensor import Sensor
from pysim.excitation import Chirp, LeadIn, LineGrid, Multisine, PiersonMoskowitz, Step, StochasticWave
from pysim.io import SI, SIGNAL_KEYS, Section, described_signal, read_toml, signal_in_si
from pysim.types import MeasuredSignal, with_place
from pysim.types.dataset import USES
from pysim.types.record_kind import STEPPED_SINE

_PLANS = Path(__file__).parent / "plans"
_KEYS = ("plan", "signals", "logging", "inputs", "lead", "tests")
_LEAD = tuple(field.name for field in fields(LeadIn))
_COMMON = ("kind", "input", "outputs", "use", "folder", "lead")


def named_plans() -> tuple[str, ...]:
    """Names of the plans that come with the package."""
    return tuple(sorted(path.stem for path in _PLANS.glob("*.toml")))


def read_plan(source: Path | str) -> Plan:
    """A plan.

    Args:
        source: a TOML file, or the name of a plan that comes with the package.
    Returns:
        everything in SI units or %; the file's numbers are in the units of its signals.
    Raises:
        BadInput: what is wrong, with file, line and remedy.
    """
    path = _PLANS / f"{source}.toml" if str(source) in named_plans() else Path(source)
    toml = read_toml(path, f"plan (a file, or one of {', '.join(named_plans())})")
    head = toml.table("plan")
    toml.whole.refuse_unknown(_KEYS)
    head.refuse_unknown(("name", "description", "system"))
    sections = toml.tables("signals")
    signals = {name: _signal(name, section) for name, section in sections.items()}
    lead = _lead(toml.optional_table("lead"), LeadIn())
    inputs = toml.optional_table("inputs")
    follows = _follows(sections, signals)
    driven = tuple(name for name, signal in signals.items() if signal.role == "input" and name not in follows)
    return Plan(
        name=head.text("name"),
        description=head.text("description", "-"),
        system=head.text("system", "-"),
        sensors=tuple(_sensor(signals[name], section) for name, section in sections.items()),
        tests=tuple(_test(section, signals, driven, lead) for section in toml.rows("tests", "test")),
        logger=_logger(toml.table("logging")),
        inputs={name: inputs.number(name) for name in inputs.values},
        units={name: (signal.unit, SI[signal.unit][1]) for name, signal in signals.items()},
        follows=follows,
    )


def _signal(name: str, section: Section) -> MeasuredSignal:
    """In the unit of the file."""
    section.refuse_unknown((*SIGNAL_KEYS, "low", "high", "rate", "follows", "ratio"))
    return described_signal(name, section)


def _follows(sections: Mapping[str, Section], signals: Mapping[str, MeasuredSignal]) -> dict[str, tuple[str, float]]:
    """Inputs that go along with another, with the ratio in SI units."""
    found = {}
    for name, section in sections.items():
        if ("follows" in section.values) != ("ratio" in section.values):
            raise section.error("follows and ratio go together; give both, or none")
        if "follows" in section.values:
            inputs = tuple(s.name for s in signals.values() if s.role == "input" and s.name != name)
            other = section.text("follows", among=inputs)
            to_si = SI[signals[name].unit][1] / SI[signals[other].unit][1]
            found[name] = (other, section.number("ratio") * to_si)
    return found


def _sensor(signal: MeasuredSignal, section: Section) -> Sensor:
    to_si = SI[signal.unit][1]
    low, high = (section.optional_number(key) for key in ("low", "high"))
    low, high = (None if value is None else to_si * value for value in (low, high))
    return with_place(section.place, lambda: Sensor(signal_in_si(signal), low, high, section.positive("rate")))


def _logger(section: Section) -> Logger:
    """One rate for all logs, or rates by the number of measured signals."""
    section.refuse_unknown(("rate", "rates", "jitter", "tick"))
    if ("rate" in section.values) == ("rates" in section.values):
        raise section.error("give rate = Hz, or rates = [[signals, Hz], ...], one of them")
    rates = section.pairs("rates") if "rates" in section.values else ((1, section.number("rate")),)
    jitter, tick = (section.not_negative(key) or 0.0 for key in ("jitter", "tick"))
    return with_place(section.place, lambda: Logger(tuple((int(count), rate) for count, rate in rates), jitter, tick))


def _lead(section: Section, usual: LeadIn) -> LeadIn:
    section.refuse_unknown(_LEAD)
    told = {name: section.optional_number(name) for name in _LEAD}
    durations = {name: getattr(usual, name) if value is None else value for name, value in told.items()}
    return with_place(section.place, lambda: LeadIn(**durations))


def _test(section: Section, signals: Mapping[str, MeasuredSignal], inputs: tuple[str, ...], lead: LeadIn) -> BenchTest:
    kind = section.text("kind", among=tuple(_KINDS))
    keys, make = _KINDS[kind]
    section.refuse_unknown((*_COMMON, *keys))
    if len(inputs) != 1 and "input" not in section.values:
        raise section.error(f"{len(inputs)} signals are inputs; say which one is driven: input = ...")
    driven = section.text("input", inputs[0] if inputs else None, among=inputs)
    common: dict[str, Any] = {"input": driven, "outputs": section.texts("outputs")}
    common |= {"use": section.text("use", "fit", among=USES)}
    common |= {"folder": section.text("folder")} if "folder" in section.values else {}
    own_lead = _lead(section.inner("lead"), lead)
    return with_place(section.place, lambda: make(section, SI[signals[driven].unit][1], own_lead, common))


def _sines(section: Section, unit: float, lead: LeadIn, common: dict[str, Any]) -> BenchTest:
    points = tuple((unit * offset, unit * amplitude) for offset, amplitude in section.pairs("points"))
    limits: dict[str, Any] = {key: section.number(key) for key in ("least", "most") if key in section.values}
    periods = section.integer("periods", 3)
    return SteppedSines(
        points=points, frequencies=section.numbers("frequencies"), periods=periods, lead=lead, **limits, **common
    )


def _chirp(section: Section, unit: float, lead: LeadIn, common: dict[str, Any]) -> BenchTest:
    offset, amplitude = (unit * section.number(key) for key in ("offset", "amplitude"))
    start, stop, sweep = (section.number(key) for key in ("start_hz", "stop_hz", "sweep"))
    return ChirpTest(command=Chirp(offset, amplitude, start, stop, sweep, lead), name=_name(section), **common)


def _wave(section: Section, unit: float, lead: LeadIn, common: dict[str, Any]) -> BenchTest:
    band = section.numbers("band_hz") if "band_hz" in section.values else None
    if band is not None and len(band) != 2:
        raise section.error("band_hz needs two numbers, lowest and highest frequency")
    command = StochasticWave(
        PiersonMoskowitz(unit * section.number("significant_height"), section.number("peak_period")),
        section.number("length"),
        section.integer("seed", least=0),
        section.integer("components", 100),
        unit * (section.optional_number("offset") or 0.0),
        None if band is None else (band[0], band[1]),
        section.flag("scatter", True),
        lead,
    )
    return WaveTest(command=command, name=_name(section), **common)


def _step(section: Section, unit: float, lead: LeadIn, common: dict[str, Any]) -> BenchTest:
    offset, height = (unit * section.number(key) for key in ("offset", "height"))
    command = Step(offset, height, section.number("length"), section.flag("back", False), lead)
    return StepTest(command=command, name=_name(section), **common)


def _multisine(section: Section, unit: float, lead: LeadIn, common: dict[str, Any]) -> BenchTest:
    period, low, high = (section.number(key) for key in ("period", "low_hz", "high_hz"))
    grid = LineGrid(
        period,
        low,
        high,
        section.text("lines", "random-odd"),
        section.integer("group", 4),
        section.integer("seed", least=0),
    )
    rms, peak = (section.optional_number(key) for key in ("rms", "peak"))
    command = Multisine(
        grid,
        section.integer("seed", least=0),
        None if rms is None else unit * rms,
        None if peak is None else unit * peak,
        offset=unit * (section.optional_number("offset") or 0.0),
        periods=section.integer("periods", 3),
        lead=lead,
    )
    return MultisineTest(
        command=command, realisations=section.integer("realisations", 1), name=_name(section), **common
    )


def _name(section: Section) -> str:
    return section.text("name") if "name" in section.values else ""


_LINES = ("lines", "group", "seed", "periods", "realisations")
_Make = Callable[[Section, float, LeadIn, dict[str, Any]], BenchTest]
_KINDS: Mapping[str, tuple[tuple[str, ...], _Make]] = {
    STEPPED_SINE.name: (("points", "frequencies", "periods", "least", "most"), _sines),
    "chirp": (("name", "offset", "amplitude", "start_hz", "stop_hz", "sweep"), _chirp),
    "stochastic": (
        ("name", "significant_height", "peak_period", "length", "seed", "components", "offset", "band_hz", "scatter"),
        _wave,
    ),
    "step": (("name", "offset", "height", "length", "back"), _step),
    "multisine": (
        (*("name", "offset", "rms", "peak", "period", "low_hz", "high_hz"), *_LINES),
        _multisine,
    ),
}
