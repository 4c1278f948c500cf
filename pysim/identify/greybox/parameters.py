"""Parameters of a fit: free, tied and fixed ones, their bounds, and the search coordinates."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, Model, Variable
from pysim.types._frozen import FrozenMapping

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Parameter:
    """One free parameter; start and bounds that are None come from the model.

    Args:
        name: variable of the model, a parameter or the start value of a state.
        start: start value of the search, in the variable's unit.
        lower, upper: bounds, in its unit.
        log: search on a logarithmic scale; None does so if the lower bound is above zero.
        record: source of the one log the value belongs to, as an unknown initial state; None for all logs.
        prior: mean and standard deviation of a Gaussian prior, in its unit; None for no prior.
    """

    name: str
    start: float | None = None
    lower: float | None = None
    upper: float | None = None
    log: bool | None = None
    record: str | None = None
    prior: tuple[float, float] | None = None

    @property
    def key(self) -> str:
        """Its name in the fit: `name`, or `name@record` for a single log."""
        return self.name if self.record is None else f"{self.name}@{self.record}"


@dataclass(frozen=True)
class Tie:
    """`name` = factor * `of`, where `of` is free."""

    name: str
    of: str
    factor: float = 1.0


@dataclass(frozen=True)
class ParameterSpace:
    """Checked free parameters p, and the map between them and the search coordinates x.

    On a logarithmic scale x = ln(p); on a linear one x = p / scale. The scale is the larger of nominal value and start
    value; if both are zero, the width of the bounds.

    Args:
        keys, variables, records, units: (n) name in the fit, variable, log it belongs to, and unit.
        start, lower, upper, scale: (n) in the variables' units.
        log: (n) whether the scale is logarithmic.
        ties, fixed: tied parameters; fixed variable -> value.
        priors: key -> mean and standard deviation of its Gaussian prior.
    """

    keys: tuple[str, ...]
    variables: tuple[str, ...]
    records: tuple[str | None, ...]
    units: tuple[str, ...]
    start: Array
    lower: Array
    upper: Array
    scale: Array
    log: NDArray[np.bool_]
    ties: tuple[Tie, ...] = ()
    fixed: Mapping[str, float] = field(default_factory=dict)
    priors: Mapping[str, tuple[float, float]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("fixed", "priors"):
            object.__setattr__(self, name, FrozenMapping(getattr(self, name)))

    @classmethod
    def held(cls, values: Mapping[str, float]) -> ParameterSpace:
        """A space without free parameters: variable -> fixed value."""
        nothing = np.zeros(0)
        return cls((), (), (), (), nothing, nothing, nothing, nothing, nothing.astype(bool), fixed=values)

    @property
    def size(self) -> int:
        """Number of free parameters."""
        return len(self.keys)

    def to_search(self, p: Array) -> Array:
        """Model values (n,) -> x (n,); infinite bounds stay infinite."""
        with np.errstate(divide="ignore"):
            return np.where(self.log, np.log(np.where(self.log, p, 1.0)), p / self.scale)

    def to_model(self, x: Array) -> Array:
        """x (n,) -> model values (n,); exactly the bound if x is at the bound."""
        low, high = self.bounds()
        p = np.where(self.log, np.exp(np.where(self.log, x, 0.0)), x * self.scale)
        return np.where(x <= low, self.lower, np.where(x >= high, self.upper, p))

    def slope(self, x: Array) -> Array:
        """dp/dx (n,)."""
        return np.where(self.log, self.to_model(x), self.scale)

    def bounds(self) -> tuple[Array, Array]:
        """Lower and upper bound of x, (n,) each."""
        return self.to_search(self.lower), self.to_search(self.upper)

    def values(self, x: Array) -> dict[str, float]:
        """Name in the fit -> value of every free, tied and fixed parameter."""
        p = dict(zip(self.keys, self.to_model(x).tolist(), strict=True))
        return {**self.fixed, **p, **{tie.name: tie.factor * p[tie.of] for tie in self.ties}}

    def prior_rows(self, x: Array) -> tuple[Array, Array]:
        """Distance of x (n,) from the means of the k priors, in standard deviations (k,), and its Jacobian (k, n)."""
        places = [place for place, key in enumerate(self.keys) if key in self.priors]
        mean, sd = np.array([self.priors[self.keys[place]] for place in places]).reshape(-1, 2).T
        rows = np.zeros((len(places), self.size))
        rows[np.arange(len(places)), places] = self.slope(x)[places] / sd
        return (self.to_model(x)[places] - mean) / sd, rows

    def overrides(self, x: Array, record: str) -> dict[str, float]:
        """Variable -> value for the run of one log; x (n,) holds all free parameters."""
        rows = list(zip(self.variables, self.records, self.to_model(x).tolist(), strict=True))
        own = {variable: value for variable, of, value in rows if of is None}
        tied = {tie.name: tie.factor * own[tie.of] for tie in self.ties}
        return {**self.fixed, **own, **tied, **{variable: value for variable, of, value in rows if of == record}}

    def chain(self, x: Array, record: str) -> tuple[tuple[str, ...], Array]:
        """Free and tied variables of the run of one log: names (n_v), and their derivatives by x (n_v, n)."""
        slope, rows = self.slope(x), {}
        for j, (variable, of) in enumerate(zip(self.variables, self.records, strict=True)):
            if of in (None, record):
                rows[variable] = np.zeros(self.size)
                rows[variable][j] = slope[j]
        for tie in self.ties:
            rows[tie.name] = tie.factor * rows[tie.of]
        return tuple(rows), np.array(list(rows.values())).reshape(len(rows), self.size)


def parameter_space(
    model: Model,
    free: Sequence[Parameter],
    *,
    fixed: Mapping[str, float] | None = None,
    ties: Sequence[Tie] = (),
) -> ParameterSpace:
    """Check the parameters; bounds and start values that are not given come from the model.

    Raises:
        BadInput: a name twice, a start outside its bounds, a logarithmic scale down to zero, a tie to
            a parameter that is not free, or a variable that cannot be set.
    """
    keys = [parameter.key for parameter in free]
    everything = [*keys, *(tie.name for tie in ties), *(fixed or {})]
    for name in everything:
        if everything.count(name) > 1:
            raise BadInput(f"fit: {name} is named twice; a parameter is free, tied or fixed")
    rows = [_resolved(model, parameter) for parameter in free]
    for tie in ties:
        _settable(model, tie.name)
        if tie.of not in [parameter.key for parameter in free if parameter.record is None]:
            raise BadInput(f"fit: {tie.name} is tied to {tie.of}, which is not free; free are {', '.join(keys)}")
        if not math.isfinite(tie.factor):
            raise BadInput(f"fit: the factor of {tie.name} = factor * {tie.of} is {tie.factor}; give a finite number")
    for name, value in (fixed or {}).items():
        _settable(model, name)
        if not math.isfinite(value):
            raise BadInput(f"fit: {name} is fixed at {value}; give a finite number in {model[name].unit}")
    columns = zip(*rows, strict=True) if rows else ((),) * 5
    start, lower, upper, scale, log = (np.array(column) for column in columns)
    return ParameterSpace(
        keys=tuple(keys),
        variables=tuple(parameter.name for parameter in free),
        records=tuple(parameter.record for parameter in free),
        units=tuple(model[parameter.name].unit for parameter in free),
        start=start,
        lower=lower,
        upper=upper,
        scale=scale,
        log=log.astype(bool),
        ties=tuple(ties),
        fixed=fixed or {},
        priors={parameter.key: parameter.prior for parameter in free if parameter.prior is not None},
    )


def _settable(model: Model, name: str) -> Variable:
    variable = model[name]
    if variable.start is None or variable.variability == "constant" or variable.causality in ("input", "independent"):
        raise BadInput(f"fit: {name} of {model.label} cannot be set; choose a parameter or the start of a state")
    if variable.type not in ("Real", "Float64", "Float32"):
        raise BadInput(f"fit: {name} of {model.label} is {variable.type}; only real numbers can be fitted")
    return variable


def _resolved(model: Model, parameter: Parameter) -> tuple[float, float, float, float, bool]:
    """Start, lower, upper, scale, log."""
    variable, name = _settable(model, parameter.name), parameter.key
    start = variable.start if parameter.start is None else parameter.start
    lower, upper = (
        own if own is not None else (infinite if of_model is None else of_model)
        for own, of_model, infinite in (
            (parameter.lower, variable.min, -math.inf),
            (parameter.upper, variable.max, math.inf),
        )
    )
    assert start is not None  # _settable has looked
    if not (math.isfinite(start) and lower < upper):
        raise BadInput(f"fit: {name} starts at {start} between {lower} and {upper}; give finite numbers that increase")
    if not lower <= start <= upper:
        raise BadInput(
            f"fit: {name} starts at {start:g}, outside its bounds {lower:g} to {upper:g} {variable.unit}; "
            "give another start, or wider bounds"
        )
    if parameter.prior is not None and not (math.isfinite(parameter.prior[0]) and 0 < parameter.prior[1] < math.inf):
        raise BadInput(f"fit: the prior of {name} is {parameter.prior}; give its mean and a standard deviation above 0")
    log = lower > 0 if parameter.log is None else parameter.log
    if log and not lower > 0:
        raise BadInput(
            f"fit: {name} has the lower bound {lower:g} and cannot be fitted on a logarithmic scale; "
            "give a positive bound, or fit it on a linear scale"
        )
    return start, lower, upper, _scale(variable, start, lower, upper), log


def _scale(variable: Variable, start: float, lower: float, upper: float) -> float:
    width = upper - lower if math.isfinite(upper - lower) else 1.0
    return max(abs(variable.nominal or 0.0), abs(start)) or width


def identifiable(model: Model) -> tuple[str, ...]:
    """Real parameters with min, max, nominal and start value: those that may differ between machines of one kind.

    Raises:
        BadInput: the model has none.
    """
    found = tuple(
        v.name
        for v in model.variables
        if v.causality == "parameter"
        and v.type in ("Real", "Float64")
        and v.min is not None
        and v.max is not None
        and v.nominal is not None
        and v.start is not None
    )
    if not found:
        raise BadInput(f"{model.label} gives no parameter min, max and nominal; name those to refit, and their bounds")
    return found
