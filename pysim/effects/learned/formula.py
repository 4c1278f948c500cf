"""A short expression for a learned curve: one or two of twenty shapes, by generalised least squares.

Each shape is first converted to the coefficients of a curve with the same knots, so that straight pieces and rounded
corners do not count against it. Components that the model's own parameters absorb are free.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_build.text.expressions import parse
from pysim.effects.law_units import quotient
from pysim.effects.learned.curve import curve_basis
from pysim.effects.learned.expression import derivative, modelica, replaced, smooth, value
from pysim.effects.learned.places import LESS
from pysim.types import EffectParameter
from pysim.types.answer import LearnedLaw

Array = NDArray[np.float64]

_DENSE = 20  # points between two knots
_KINK = 0.05  # rounding of a kink over the shortest interval
_COARSE = 0.01  # standard deviation of what the knots cannot represent of a smooth law, over the curve's rms
_WIDTHS = 12  # widths that are tried of each shape
_REFINED = 16  # best of the single and paired shapes whose widths are refined; those of all single ones are
_ABSORBED = 1e-6  # share of a shape below which it counts as a combination of other columns
_SURE = 3.09  # standard deviations of a normal distribution that are exceeded with a chance of 0.1 %
_STEPS = 20  # golden-section steps
REACH = 10.0  # bounds of an amount over its value


@dataclass(frozen=True)
class Shape:
    """One kind of curve, which a formula multiplies by an amount.

    Args:
        name: for readers.
        form: Modelica expression of the argument z and, if the shape has a width or place, of w.
        power: power of the argument's unit in it, such as 2 for z^2; needed for the unit of the amount.
        is_place: whether w is a place on the argument's axis, of either sign, rather than a width.
    """

    name: str
    form: str
    power: float = 0
    is_place: bool = False

    @property
    def sized(self) -> bool:
        return re.search(r"\bw\b", self.form) is not None


SHAPES = (
    Shape("constant", "1"),
    Shape("line", "z", 1),
    Shape("square", "z^2", 2),
    Shape("signed square", "z*abs(z)", 2),
    Shape("cube", "z^3", 3),
    Shape("fourth power", "z^4", 4),
    Shape("size", "abs(z)", 1),
    Shape("root", "sqrt(abs(z))", 0.5),
    Shape("signed root", "sign(z)*sqrt(abs(z))", 0.5),
    Shape("sign", "sign(z)"),
    Shape("smooth sign", "tanh(z/w)"),
    Shape("decay", "exp(-abs(z)/w)"),
    Shape("signed decay", "sign(z)*exp(-abs(z)/w)"),
    Shape("bell", "exp(-(z/w)^2)"),
    Shape("hyperbola", "1/(1 + abs(z)/w)"),
    Shape("resonance", "1/(1 + (z/w)^2)"),
    Shape("one side", "max(z, 0)", 1),
    Shape("from a place on", "max(z - w, 0)", 1, is_place=True),
    Shape("beyond a band", "sign(z)*max(abs(z) - w, 0)", 1),
    Shape("limited", "sign(z)*min(abs(z), w)", 1),
)


@dataclass(frozen=True)
class Formula:
    """An expression for a learned curve.

    Args:
        shapes: names of its shapes.
        expression: Modelica expression of z and the parameters' names, with sharp kinks, for readers.
        parameters: amounts, 0 for off, and widths or places, with their values as defaults.
        covariance: (k, k) of the parameters, in their order.
        kink: half width over which `abs`, `sign`, `min` and `max` are rounded, in the argument's unit.
        absorbed: (a,) amounts of the components that the model's own parameters absorb, in the curve's unit.
        score: gain over a zero curve, less the penalty, nats.
        explained: share of the curve's sum of squares, weighted by its covariance, 0 ... 1.
    """

    shapes: tuple[str, ...]
    expression: str
    parameters: tuple[EffectParameter, ...]
    covariance: Array = field(repr=False)
    kink: float
    absorbed: Array = field(repr=False)
    score: float
    explained: float

    def text(self, argument: str) -> str:
        """The formula with numbers in place of parameters: `1.2e+04 + 3.1e+07*x^2`."""
        numbers = {p.name: f"{p.default:.3g}" if p.default >= 0 else f"({p.default:.3g})" for p in self.parameters}
        text = replaced(self.expression, {**numbers, "z": f"({argument})" if LESS in argument else argument})
        text = text.replace(f"(({argument}))", f"({argument})")
        return re.sub(r"(^| \+ )\(-([^()]*)\)", lambda found: ("-" if not found[1] else " - ") + found[2], text)

    def written(self, argument: str) -> str:
        """Modelica text of the formula with the parameters' names; kinks are rounded, to be differentiable."""
        return modelica(smooth(parse(replaced(self.expression, {"z": argument})), self.kink))

    def slope(self, argument: str) -> str:
        """Its derivative by the argument, in the same form."""
        tree = smooth(parse(replaced(self.expression, {"z": argument})), self.kink)
        return modelica(derivative(tree, argument))

    def __call__(self, z: Array, values: Mapping[str, float] = MappingProxyType({})) -> Array:
        """The curve at arguments z, kinks rounded.

        Args:
            values: of parameters, where they differ from their defaults.
        """
        known = {p.name: p.default for p in self.parameters} | dict(values) | {"z": np.asarray(z, dtype=float)}
        return np.asarray(value(smooth(parse(self.expression), self.kink), known) + 0 * known["z"])


def formulas(law: LearnedLaw) -> tuple[Formula, ...]:
    """Formulas that describe the curve within the uncertainty of its coefficients, best first; none for mere noise.

    Source: generalised least squares; BIC (Schwarz 1978, Annals of Statistics 6:461) and a penalty of the number tried.
    """
    target = _Target(law)
    if not target.is_curve:
        return ()
    found = [target.fitted(*one) for k, one in enumerate(target.starts()) if k < _REFINED or len(one[0]) == 1]
    good = [one for one in found if one.score > 0 and target.describes(one)]
    return tuple(sorted(good, key=lambda one: -one.score))


class _Target:
    """A learned curve, weighted by the inverse of its covariance."""

    def __init__(self, law: LearnedLaw) -> None:
        self._law = law
        knots, m = law.knots, law.knots.size
        self._size = float(np.sqrt(np.mean(law.coefficients**2))) or 1.0
        self._kink = _KINK * float(np.min(np.diff(knots)))
        places = np.arange(m - 1)[:, None] + np.linspace(0, 1, _DENSE, endpoint=False)
        self._dense = np.interp(np.append(places.ravel(), m - 1), np.arange(m), knots)
        self._to_knots = np.linalg.pinv(curve_basis(self._dense, knots))
        sizes, turned = np.linalg.eigh(law.covariance)
        spread = np.sqrt(np.maximum(sizes, 0) + (_COARSE * self._size) ** 2)
        self._white = (turned / spread) @ turned.T
        absorbed = law.absorbed if law.absorbed.size else np.zeros((m, 0))
        self._free = absorbed / np.maximum(np.linalg.norm(absorbed, axis=0), np.finfo(float).tiny)
        self._values = self._white @ law.coefficients
        self._alone = self._left(np.zeros((m, 0)))[0]
        self._df = m - self._free.shape[1]

    @property
    def is_curve(self) -> bool:
        """Whether the curve is more than noise once the absorbed components are removed (chi-squared test)."""
        return self._df > 0 and self._alone > _chi_square(self._df)

    def describes(self, one: Formula) -> bool:
        """Whether the formula leaves no more than the uncertainty of the coefficients (chi-squared test)."""
        left = (1 - one.explained) * self._alone
        return left <= _chi_square(max(self._df - len(one.parameters), 1))

    def starts(self) -> list[tuple[tuple[Shape, ...], Array]]:
        """Every shape and every pair of shapes, with the best widths or places of a grid; the best score first."""
        grid, raw = self._grid()
        columns = self._white @ raw
        turned = np.linalg.qr(self._white @ self._free)[0]
        lengths = np.linalg.norm(columns, axis=0)
        columns, target = (one - turned @ (turned.T @ one) for one in (columns, self._values))
        own = np.linalg.norm(columns, axis=0)
        units = columns * np.where(own > _ABSORBED * lengths, 1 / np.maximum(own, np.finfo(float).tiny), 0)
        along = units.T @ target
        both = units.T @ units
        rest = np.maximum(1 - both**2, _ABSORBED)
        gains = (along[:, None] ** 2 + along**2 - 2 * both * along[:, None] * along) / rest
        np.fill_diagonal(gains, along**2)
        best: dict[tuple[int, ...], tuple[float, Array]] = {}
        for i, j in zip(*np.triu_indices(len(grid)), strict=True):
            pair = (grid[i][0],) if i == j else (grid[i][0], grid[j][0])
            if len(set(pair)) == len(pair) and gains[i, j] > best.get(pair, (-1.0,))[0]:
                best[pair] = float(gains[i, j]), np.array([grid[k][1] for k in ((i,) if i == j else (i, j))])
        found = [(tuple(SHAPES[k] for k in pair), *one) for pair, one in best.items()]
        found.sort(key=lambda one: self._penalty(one[0]) - 0.5 * one[1])
        return [(shapes, sizes) for shapes, _, sizes in found]

    def _grid(self) -> tuple[list[tuple[int, float]], Array]:
        """Numbers of shapes with their widths or places, and the columns of them.

        A shape that is an earlier one over this range stays out, as the size of a time that is never negative.
        """
        grid = [(k, float(size)) for k, shape in enumerate(SHAPES) for size in self._sizes(shape)]
        columns = self._columns([SHAPES[k] for k, _ in grid], [size for _, size in grid])
        units = columns / np.maximum(np.linalg.norm(columns, axis=0), np.finfo(float).tiny)
        alike = 1 - np.abs(units.T @ units) < 0.5 * _COARSE**2  # distance of columns of length 1 below _COARSE
        new = [
            i for i, (k, size) in enumerate(grid)
            if not any(alike[i, j] and SHAPES[grid[j][0]].sized == SHAPES[k].sized for j in range(i) if grid[j][0] < k)
        ]  # fmt: skip
        return [grid[i] for i in new], columns[:, new]

    def _penalty(self, shapes: tuple[Shape, ...]) -> float:
        df = len(shapes) + sum(shape.sized for shape in shapes)
        return 0.5 * df * math.log(max(self._df, 2)) + math.log(math.comb(len(SHAPES), len(shapes)))

    def fitted(self, shapes: tuple[Shape, ...], start: Array) -> Formula:
        """The formula of some shapes: their widths or places refined from a start, their amounts, and the score."""
        sizes = self._refined(shapes, start)
        columns = self._columns(shapes, sizes)
        left, amounts = self._left(columns)
        own, absorbed = amounts[: len(shapes)], amounts[len(shapes) :]
        # Shapes may be larger than the curve where they cancel. An amount that may be n times as large costs ln n.
        times = np.abs(own) * np.sqrt(np.mean(columns**2, axis=0)) / self._size
        score = 0.5 * (self._alone - left) - self._penalty(shapes) - float(np.sum(np.log(np.maximum(times, 1.0))))
        expression, parameters = self._written(shapes, own, sizes)
        jacobian = self._jacobian(shapes, sizes, own)
        lengths = np.linalg.norm(jacobian, axis=0)
        lengths[lengths == 0] = 1.0
        covariance = np.linalg.pinv((jacobian / lengths).T @ (jacobian / lengths)) / np.outer(lengths, lengths)
        covariance = covariance[: len(parameters), : len(parameters)]
        names = tuple(shape.name for shape in shapes)
        explained = 1 - left / self._alone if self._alone > 0 else 0.0
        return Formula(names, expression, parameters, covariance, self._kink, absorbed, score, explained)

    def _sizes(self, shape: Shape) -> Array:
        """Widths or places to try, (k,); one nan for a shape without."""
        if not shape.sized:
            return np.array([math.nan])
        knots = self._law.knots
        if shape.is_place:
            return np.linspace(knots[0], knots[-1], _WIDTHS + 2)[1:-1]
        return np.geomspace(0.25 * np.min(np.diff(knots)), np.max(np.abs(knots)), _WIDTHS)

    def _columns(self, shapes: Sequence[Shape], sizes: Any) -> Array:
        """Curve coefficients of each shape, (m, len(shapes)); `sizes` holds a width or place for each."""
        curves = [
            value(smooth(parse(shape.form), self._kink), {"z": self._dense, "w": float(size)}) + 0 * self._dense
            for shape, size in zip(shapes, sizes, strict=True)
        ]
        return np.asarray(self._to_knots @ np.column_stack(curves))

    def _left(self, columns: Array) -> tuple[float, Array]:
        """Weighted sum of squares that is left, and the amounts of the columns and of the absorbed components.

        Linearly dependent columns share their amount, by the least-squares solution of minimum norm.
        """
        design = self._white @ np.hstack([columns, self._free])
        lengths = np.linalg.norm(design, axis=0)
        lengths[lengths == 0] = 1.0
        amounts = np.linalg.lstsq(design / lengths, self._values, rcond=1e-9)[0] / lengths
        return float(np.sum((self._values - design @ amounts) ** 2)), np.asarray(amounts)

    def _refined(self, shapes: tuple[Shape, ...], sizes: Array) -> Array:
        """Widths or places refined between neighbours on the grid, one after the other, by golden-section search."""
        ratio = (math.sqrt(5) - 1) / 2
        for k in [k for k, shape in enumerate(shapes) if shape.sized] * (1 if len(shapes) == 1 else 3):
            grid = self._sizes(shapes[k])
            at = int(np.argmin(np.abs(grid - sizes[k])))
            low, high = float(grid[max(at - 1, 0)]), float(grid[min(at + 1, len(grid) - 1)])
            for _ in range(_STEPS):
                trials = high - ratio * (high - low), low + ratio * (high - low)
                a, b = (self._left(self._columns(shapes, [*sizes[:k], w, *sizes[k + 1 :]]))[0] for w in trials)
                low, high = (low, trials[1]) if a < b else (trials[0], high)
            sizes = np.array([*sizes[:k], (low + high) / 2, *sizes[k + 1 :]])
        return sizes

    def _jacobian(self, shapes: tuple[Shape, ...], sizes: Array, own: Array) -> Array:
        """Jacobian of the weighted curve by amounts and widths, in the parameters' order, then by what is absorbed."""
        columns = []
        for k, shape in enumerate(shapes):
            columns.append(self._columns((shape,), sizes[k : k + 1])[:, 0])
            if shape.sized:
                step = 1e-4 * (abs(sizes[k]) + self._kink)
                either = [self._columns((shape,), [sizes[k] + sign * step])[:, 0] for sign in (1, -1)]
                columns.append(own[k] * (either[0] - either[1]) / (2 * step))
        return np.asarray(self._white @ np.hstack([np.column_stack(columns), self._free]))

    def _written(self, shapes: tuple[Shape, ...], own: Array, sizes: Array) -> tuple[str, tuple[EffectParameter, ...]]:
        """The Modelica expression of the formula, and its parameters."""
        unit, argument = self._law.unit or "1", self._law.argument_unit or "1"
        terms, parameters = [], []
        for k, (shape, amount, size) in enumerate(zip(shapes, own, sizes, strict=True), start=1):
            nominal, about = rounded_up(float(amount)), f"Amount of the {shape.name}, 0 = off"
            bounds = (-REACH * nominal, REACH * nominal, nominal)
            whole = shape.power == int(shape.power)  # SI units cannot express a root
            of = quotient(unit, argument, int(shape.power)) if whole else "1"
            parameters.append(EffectParameter(f"a_{k}", of, *bounds, _shortened(amount), 0.0, about))
            terms.append(f"a_{k}" if shape.form == "1" else f"a_{k}*{replaced(shape.form, {'w': f'w_{k}'})}")
            if shape.sized:
                nominal = rounded_up(max(abs(float(size)), self._kink))
                about = f"{'Place' if shape.is_place else 'Width'} of the {shape.name}"
                bounds = (-REACH * nominal if shape.is_place else nominal / 100, REACH * nominal, nominal)
                parameters.append(EffectParameter(f"w_{k}", argument, *bounds, _shortened(size), None, about))
        return " + ".join(terms), tuple(parameters)


def rounded_up(value: float) -> float:
    """Absolute value, rounded up to one digit; 1 for zero."""
    if value == 0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(abs(value)))
    return float(f"{math.ceil(abs(value) / power) * power:.1g}")


def _shortened(value: float) -> float:
    return float(f"{value:.8g}")


def _chi_square(df: int) -> float:
    """The 99.9 % quantile of the chi-squared distribution.

    Source: Wilson and Hilferty 1931, PNAS 17:684.
    """
    return df * (1 - 2 / (9 * df) + _SURE * math.sqrt(2 / (9 * df))) ** 3
