"""A system and its run from a TOML file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from pysim.cosim._prepare import check_heard, undriven
from pysim.cosim._python_class import made, python_class
from pysim.cosim._rows import row_times
from pysim.cosim.bond import Bond
from pysim.cosim.connection import Connection
from pysim.cosim.doubling import Doubling
from pysim.cosim.gauss_seidel import GaussSeidel
from pysim.cosim.iterated import Iterated
from pysim.cosim.jacobi import Jacobi
from pysim.cosim.members import Fmu, Isolated
from pysim.cosim.order import Order
from pysim.cosim.plain import Unwired, sampled, wired
from pysim.cosim.sampled import Sampled
from pysim.cosim.system import System
from pysim.io import Section, TomlFile, read_model, read_signal, read_toml
from pysim.simulate import Rodas
from pysim.types import BadInput, Experiment, Signal, with_place

_FMU = ("fmu", "interface", "parameters", "record", "tolerance", "events", "feedthrough", "isolated", "time_limit")
_BLOCK = ("block", "settings", "every", "delay", "hold")
_MEMBER = ("member", "settings")
_RUN = ("start", "stop", "step", "rows_every", "order", "lines", "sequence", "tolerance", "record")
_ORDERS = ("jacobi", "gauss-seidel", "iterated")


@dataclass(frozen=True)
class SystemFile:
    """What stands in a file: arguments of `cosimulate`.

    Args:
        name: of the whole, for headings.
        step: s between two communication points.
    """

    name: str
    system: System
    experiment: Experiment
    step: float
    order: Order
    doubling: Doubling | None


def read_system_file(path: Path | str, *, stop: float | None = None, step: float | None = None) -> SystemFile:
    """A system with its run.

    Files it names are relative to its own folder. Python classes it names are imported: whoever wrote it can run code.

    Args:
        stop, step: s, in place of the file's own.
    Raises:
        BadInput: what is wrong, with file, line and remedy.
    """
    path = Path(path)
    toml = read_toml(path, "system")
    toml.whole.refuse_unknown(("system", "members", "connections", "bonds", "inputs", "overrides", "run"))
    head = toml.optional_table("system")
    head.refuse_unknown(("name",))
    run = toml.table("run")
    run.refuse_unknown(_RUN)
    size = run.positive("step") if step is None else step
    if size is None:
        raise run.error("step is missing; write step = and the seconds between two communication points")
    parts = [_member(name, section, path.parent, size) for name, section in toml.tables("members").items()]
    wires = toml.rows("connections", "connection") if "connections" in toml.whole.values else ()
    members = with_place(str(path), lambda: wired(parts, [(one.text("from"), one.text("to")) for one in wires]))
    unwired = with_place(str(path), lambda: System(members))
    connections = tuple(with_place(one.place, partial(_connection, one, unwired)) for one in wires)
    system = with_place(str(path), lambda: System(members, connections, _bonds(toml)))
    experiment = with_place(run.place, lambda: _experiment(toml, run, system, size, stop))
    _check_driven(path, system, experiment)
    with_place(str(path), lambda: check_heard(system, run.texts("record") if "record" in run.values else ()))
    return SystemFile(
        name=head.text("name", path.stem),
        system=system,
        experiment=experiment,
        step=size,
        order=_order(run),
        doubling=with_place(run.place, lambda: _doubling(run)),
    )


def _check_driven(path: Path, system: System, experiment: Experiment) -> None:
    free = undriven(system, experiment)
    if free:
        raise BadInput(
            f'{path}: nothing drives {", ".join(free)}; add [[connections]] with to = "{free[0]}", or under [inputs] a '
            f"number or a file, {free[0]} = 0.0"
        )


def _member(name: str, section: Section, folder: Path, step: float) -> Any:
    kinds = [key for key in ("fmu", "block", "member") if key in section.values]
    if len(kinds) != 1:
        raise section.error(f'say what {name} is: fmu = "FILE.fmu", block = "CLASS" or member = "CLASS"')
    if kinds == ["block"]:
        return _block(name, section, folder, step)
    return {"fmu": _fmu, "member": _other}[kinds[0]](name, section, folder)


def _fmu(name: str, section: Section, folder: Path) -> Any:
    section.refuse_unknown(_FMU)
    tolerance, limit = section.positive("tolerance"), section.positive("time_limit")
    parameters = _numbers(section.inner("parameters"))

    def make() -> Any:
        fmu = Fmu(
            name,
            read_model(folder / section.text("fmu")),
            parameters=parameters,
            record=section.texts("record") if "record" in section.values else (),
            interface=section.text("interface") if "interface" in section.values else "",
            solver=Rodas() if tolerance is None else Rodas(rtol=tolerance, atol=tolerance),
            events=section.flag("events", True),
            feedthrough=section.text("feedthrough", "standard"),
        )
        if tolerance is not None and fmu.interface == "co-simulation":
            cure = 'remove it, or write interface = "model-exchange"'
            raise section.error(f"an FMU that steps by itself takes no tolerance; {cure}")
        if not section.flag("isolated", limit is not None):
            return fmu
        return Isolated(fmu) if limit is None else Isolated(fmu, time_limit=limit)

    return with_place(section.place, make)


def _block(name: str, section: Section, folder: Path, step: float) -> Sampled | Unwired:
    """A block, or a plain class with `step(t, ...)`; sampled as it says itself, or at each step of the run."""
    section.refuse_unknown(_BLOCK)
    text, settings = section.text("block"), section.inner("settings").values
    block = made(python_class(text, folder, section.place), settings, text, section.place)
    every = section.positive("every") or getattr(block, "dt", None) or step
    delay, hold = section.not_negative("delay") or 0.0, section.integer("hold", 0)
    return with_place(section.place, lambda: sampled(name, block, every, delay, hold))


def _other(name: str, section: Section, folder: Path) -> Any:
    section.refuse_unknown(_MEMBER)
    text, settings = section.text("member"), section.inner("settings").values
    return made(python_class(text, folder, section.place), {"name": name, **settings}, text, section.place)


def _connection(section: Section, unwired: System) -> Connection:
    section.refuse_unknown(("from", "to", "factor", "offset"))
    factor, offset = section.optional_number("factor"), section.optional_number("offset") or 0.0
    connection = Connection(section.text("from"), section.text("to"), factor, offset)
    source, target = unwired.port("output", connection.source), unwired.port("input", connection.target)
    connection.check_units(source.unit, target.unit)
    return connection


def _bonds(toml: TomlFile) -> tuple[Bond, ...]:
    if "bonds" not in toml.whole.values:
        return ()
    found = []
    for section in toml.rows("bonds", "bond"):
        section.refuse_unknown(("name", "effort", "flow"))
        found.append(Bond(section.text("name"), section.text("effort"), section.text("flow")))
    return tuple(found)


def _order(run: Section) -> Order:
    name, lines = run.text("order", "jacobi", among=_ORDERS), run.flag("lines", False)
    if name != "gauss-seidel" and "sequence" in run.values:
        raise run.error(f'{name} steps know no sequence; remove it, or write order = "gauss-seidel"')
    if name == "iterated":
        if lines:
            raise run.error("iterated steps join the inputs' values by lines anyhow; remove lines")
        return Iterated()
    if name == "gauss-seidel":
        return GaussSeidel(run.texts("sequence") if "sequence" in run.values else (), lines)
    return Jacobi(lines)


def _doubling(run: Section) -> Doubling | None:
    rtol = run.positive("tolerance")
    return None if rtol is None else Doubling(rtol=rtol)


def _experiment(toml: TomlFile, run: Section, system: System, step: float, stop: float | None) -> Experiment:
    start, end = run.optional_number("start") or 0.0, run.number("stop") if stop is None else stop
    every = run.positive("rows_every") or step
    if not start + every <= end:
        raise run.error(f"no row lies between start = {start:g} s and stop = {end:g} s; move the stop")
    rows = row_times(start, end, step, every)
    record = run.texts("record") if "record" in run.values else tuple(system.outputs)
    overrides = _numbers(_table(toml, "overrides"))
    return Experiment(rows, record, _inputs(toml), overrides, start)


def _table(toml: TomlFile, key: str) -> Section:
    """[key], which may as well be absent or empty."""
    return Section(f"{toml.path}, [{key}]", {}) if toml.whole.values.get(key) == {} else toml.optional_table(key)


def _inputs(toml: TomlFile) -> dict[str, Signal]:
    section = _table(toml, "inputs")
    return {name: _signal(value, f"{section.place}, {name}", toml) for name, value in _flat(section.values).items()}


def _signal(value: Any, place: str, toml: TomlFile) -> Signal:
    if isinstance(value, str):
        return with_place(place, lambda: read_signal(toml.path.parent / value, place))
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise BadInput(f'{value!r} is no number; write one, or the name of a file as "reference.csv"', where=place)
    return with_place(place, lambda: Signal.constant(float(value)))


def _numbers(section: Section) -> dict[str, float]:
    """Numbers by name; a name with a dot need not be quoted."""
    flat = Section(section.place, _flat(section.values))
    return {name: flat.number(name) for name in flat.values}


def _flat(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """pump.tau = 1 is read as a table within a table: the names are put together again."""
    found: dict[str, Any] = {}
    for key, value in table.items():
        found |= _flat(value, f"{prefix}{key}.") if isinstance(value, dict) else {prefix + key: value}
    return found
