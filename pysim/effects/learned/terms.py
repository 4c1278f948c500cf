"""The Modelica text that is compiled to try learned laws at a place.

One model is compiled for each place. Its parameters choose argument and factor by weights (1 for the chosen one, 0 for
the others), and hold knots and coefficients, so that another law or other knots need no new compilation. One model with
terms at all places would make derivatives by the coefficients ten times as expensive.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from pysim.effects.learned.places import Place


@dataclass(frozen=True)
class Terms:
    """Terms at some places, off until their parameters are set.

    Args:
        places: get one term each.
        count: number of knots of each curve.
        memory: whether the factor may be a bristle or a tone, which costs a state.
    """

    places: tuple[Place, ...]
    count: int
    memory: bool = False

    @property
    def probes(self) -> tuple[str, ...]:
        """Which variable is added to which equation, in the form of `fmu_build.build(probes=...)`."""
        found = []
        for place in self.places:
            for i, side in enumerate(place.sides, start=1):
                found.append(f"{side.output}={place.key}_y{i}")
                if side.output_rate:
                    found.append(f"{side.output_rate}={place.key}_r{i}")
        return tuple(found)

    @property
    def text(self) -> str:
        """Modelica declarations and equations."""
        declared: list[str] = []
        equations: list[str] = []
        for place in self.places:
            key, numbers = place.key, range(1, self.count + 1)
            declared += [f"  parameter Real {name} = 0;" for name in place.coefficients(self.count)]
            declared += [f"  parameter Real {key}_k{i} = {i};" for i in numbers]
            declared += [f"  parameter Real {key}_w{i} = 0.25;" for i in numbers]
            declared += [f"  parameter Real {key}_a{i} = 0;" for i in range(len(place.arguments))]
            declared += [f"  parameter Real {key}_b = 0;", f"  parameter Real {key}_u = 1;"]
            for i in range(len(place.sides[0].own)):
                declared += [f"  parameter Real {key}_{weight}{i} = 0;" for weight in ("bsm" if self.memory else "bs")]
                declared += [f"  parameter Real {key}_d{i} = 1;"]
            if self.memory:
                declared += [f"  parameter Real {key}_{name} = 0;" for name in "tfp"]
                declared += [f"  parameter Real {key}_l = 1;"]
            for n, side in enumerate(place.sides, start=1):
                declared += [f"  Real {key}_z{n};", f"  Real {key}_h{n};", f"  Real {key}_y{n};"]
                seen = (*side.own, *place.outside)
                weighted = [f"{key}_a{i}*{name}" for i, name in enumerate(seen)]
                equations.append(f"  {key}_z{n} = {' + '.join(weighted)};")
                equations.append(f"  {key}_h{n} = {key}_u*({_curve(key, f'{key}_z{n}', self.count)});")
                factors = [f"{key}_b"]
                if not side.output_rate:
                    for i, name in enumerate(side.own):
                        factors += [f"{key}_b{i}*{name}", f"{key}_s{i}*tanh({name}/{key}_d{i})"]
                if self.memory:
                    factors.append(f"{key}_t*cos({key}_f*time + {key}_p)")
                    if place.speeds:
                        pulls = " + ".join(f"{key}_m{i}*{side.own[i]}" for i in place.speeds)
                        declared += [f"  Real {key}_v;", f"  Real {key}_s(start=0, fixed=true);"]
                        equations.append(f"  {key}_v = {pulls};")
                        equations.append(f"  der({key}_s) = ({key}_v - noEvent(abs({key}_v))*{key}_s)/{key}_l;")
                        factors.append(f"{key}_s")
                equations.append(f"  {key}_y{n} = ({' + '.join(factors)})*{key}_h{n};")
                if side.output_rate:
                    declared.append(f"  Real {key}_r{n};")
                    rate = " + ".join(f"{key}_a{i}*{name}" for i, name in enumerate(side.rates))
                    slope = _slope(key, f"{key}_z{n}", self.count)
                    equations.append(f"  {key}_r{n} = {key}_u*{key}_b*({slope})*({rate});")
        return "\n".join([*declared, "equation", *equations, ""])


def wrapped(base: str, term: Terms, name: str) -> str:
    """Modelica text of a class that extends the model `base` by a term."""
    return f'model {name} "{base} with a law more"\n  extends {base};\n{term.text}end {name};\n'


def _turns(key: str, count: int) -> Iterator[tuple[str, str, str]]:
    """For each knot the Modelica text of its position, of its corner's width, and of the change of slope there."""
    rises = [f"({key}_c{i + 1} - {key}_c{i})/({key}_k{i + 1} - {key}_k{i})" for i in range(1, count)]
    for i in range(count):
        before, after = (rises[i - 1] if i else ""), (rises[i] if i < count - 1 else "")
        turn = f"{after} - {before}" if before and after else after or f"-{before}"
        yield f"{key}_k{i + 1}", f"{key}_w{i + 1}", turn


def _curve(key: str, z: str, count: int) -> str:
    ramps = [f"({turn})*0.5*({z} - {k} + sqrt(({z} - {k})^2 + {w}^2))" for k, w, turn in _turns(key, count)]
    return " + ".join([f"{key}_c1", *ramps])


def _slope(key: str, z: str, count: int) -> str:
    return " + ".join(
        f"({turn})*0.5*(1 + ({z} - {k})/sqrt(({z} - {k})^2 + {w}^2))" for k, w, turn in _turns(key, count)
    )
