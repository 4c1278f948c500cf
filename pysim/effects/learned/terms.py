"""The Modelica text that is compiled to try learned laws at a place.

One model is compiled for each place. Its parameters choose argument and factor by weights (1 for the chosen one, 0 for
the others), and hold knots and coefficients, so that another law or other knots need no new compilation. One model with
terms at all places would make derivatives by the coefficients ten times as expensive. Laws that were kept have their
terms in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from pysim.effects.learned.places import Place


@dataclass(frozen=True)
class Term:
    """A term at one place, off until its parameters are set.

    Args:
        place: where it is added.
        count: number of knots of its curve.
        memory: whether the factor may be a bristle or a tone, which costs a state.
    """

    place: Place
    count: int
    memory: bool = False

    @property
    def probes(self) -> tuple[str, ...]:
        """Which variable is added to which equation, in the form of `fmu_build.build(probes=...)`."""
        found = []
        for i, side in enumerate(self.place.sides, start=1):
            found.append(f"{side.output}={self.place.key}_y{i}")
            if side.output_rate:
                found.append(f"{side.output_rate}={self.place.key}_r{i}")
        return tuple(found)

    @property
    def declarations(self) -> list[str]:
        """Modelica declarations, a line each."""
        place, key, numbers = self.place, self.place.key, range(1, self.count + 1)
        found = [f"parameter Real {name} = 0;" for name in place.coefficients(self.count)]
        found += [f"parameter Real {key}_k{i} = {i};" for i in numbers]
        found += [f"parameter Real {key}_w{i} = 0.25;" for i in numbers]
        found += [f"parameter Real {key}_a{i} = 0;" for i in range(len(place.arguments))]
        found += [f"parameter Real {key}_b = 0;", f"parameter Real {key}_u = 1;"]
        for i in range(len(place.sides[0].own)):
            found += [f"parameter Real {key}_{weight}{i} = 0;" for weight in ("bsm" if self.memory else "bs")]
            found += [f"parameter Real {key}_d{i} = 1;"]
        if self.memory:
            found += [f"parameter Real {key}_{name} = 0;" for name in "tfp"]
            found += [f"parameter Real {key}_l = 1;"]
        for n, side in enumerate(place.sides, start=1):
            found += [f"Real {key}_z{n};", f"Real {key}_h{n};", f"Real {key}_y{n};"]
            if self.memory and place.pulls:
                found += [f"Real {key}_v;", f"Real {key}_s(start=0, fixed=true);"]
            if side.output_rate:
                found.append(f"Real {key}_r{n};")
        return found

    @property
    def equations(self) -> list[str]:
        """Modelica equations, a line each."""
        place, key, found = self.place, self.place.key, list[str]()
        for n, side in enumerate(place.sides, start=1):
            weighted = [f"{key}_a{i}*({name})" for i, name in enumerate((*side.own, *place.outside))]
            found.append(f"{key}_z{n} = {' + '.join(weighted)};")
            found.append(f"{key}_h{n} = {key}_u*({_curve(key, f'{key}_z{n}', self.count)});")
            factors = [f"{key}_b"]
            if not side.output_rate:
                for i, name in enumerate(side.own):
                    factors += [f"{key}_b{i}*{name}", f"{key}_s{i}*tanh({name}/{key}_d{i})"]
            if self.memory:
                factors.append(f"{key}_t*cos({key}_f*time + {key}_p)")
                if place.pulls:
                    pulls = " + ".join(f"{key}_m{i}*{speed}" for i, speed in place.pulls.items())
                    found.append(f"{key}_v = {pulls};")
                    found.append(f"der({key}_s) = ({key}_v - noEvent(abs({key}_v))*{key}_s)/{key}_l;")
                    factors.append(f"{key}_s")
            found.append(f"{key}_y{n} = ({' + '.join(factors)})*{key}_h{n};")
            if side.output_rate:
                rate = " + ".join(f"{key}_a{i}*{name}" for i, name in enumerate(side.rates))
                slope = _slope(key, f"{key}_z{n}", self.count)
                found.append(f"{key}_r{n} = {key}_u*{key}_b*({slope})*({rate});")
        return found


def wrapped(base: str, terms: Sequence[Term], name: str) -> str:
    """Modelica text of a class that extends the model `base` by terms."""
    declared = [line for term in terms for line in term.declarations]
    lines = [f"extends {base};", *declared, "equation", *(line for term in terms for line in term.equations)]
    return f'model {name} "{base} with laws more"\n' + "".join(f"  {line}\n" for line in lines) + f"end {name};\n"


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
