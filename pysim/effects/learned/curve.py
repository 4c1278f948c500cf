"""The curve of a learned law: straight lines between knots, with rounded corners, and constant beyond the ends."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
ROUND = 0.25  # width of a rounded corner over the shorter interval beside it; of one at the ends over a quarter of that


def widths(knots: Array) -> Array:
    """Width (m,) of the rounded corner at each of the knots (m,)."""
    steps = np.diff(knots)
    found = ROUND * np.minimum(np.append(steps, np.inf), np.append(np.inf, steps))
    found[[0, -1]] *= ROUND
    return np.asarray(found)


def curve_basis(z: Array, knots: Array) -> Array:
    """Basis functions (n, m): the curve at z (n,) is `curve_basis(z, knots) @ coefficients`.

    Each interval adds its slope times the difference of the rounded ramps that begin at its two ends. Rows sum to 1.
    """
    away = np.asarray(z)[:, None] - knots
    ramps = 0.5 * (away + np.sqrt(away**2 + widths(knots) ** 2))
    rises = (ramps[:, :-1] - ramps[:, 1:]) / np.diff(knots)  # 0 below an interval, 1 above it
    whole = np.ones((len(away), 1))
    steps = np.hstack([whole, rises, 0 * whole])
    return np.asarray(steps[:, :-1] - steps[:, 1:])


# The curve and its derivative as Modelica functions, for the class of a law.
RAMP = """function ramp "0 below, s above, with a rounded corner in between"
    input Real s "Distance from the corner";
    input Real w "Width of the corner";
    output Real y "Ramp";
  algorithm
    y := 0.5*(s + sqrt(s^2 + w^2));
    annotation(Inline=true, smoothOrder=2);
  end ramp"""
CURVE = """function curve "Straight lines through points, their corners rounded; constant beyond the ends"
    input Real u "Where";
    input Real x[:] "Knots, increasing";
    input Real w[size(x, 1)] "Widths of the corners there";
    input Real c[size(x, 1)] "Values there";
    output Real y "Curve";
  algorithm
    y := c[1];
    for i in 2:size(x, 1) loop
      y := y + (c[i] - c[i - 1])/(x[i] - x[i - 1])*(ramp(u - x[i - 1], w[i - 1]) - ramp(u - x[i], w[i]));
    end for;
    annotation(Inline=true, smoothOrder=2);
  end curve"""
SLOPE = """function slope "Derivative of curve"
    input Real u "Where";
    input Real x[:] "Knots, increasing";
    input Real w[size(x, 1)] "Widths of the corners there";
    input Real c[size(x, 1)] "Values there";
    output Real y "Slope";
  algorithm
    y := 0;
    for i in 2:size(x, 1) loop
      y := y + (c[i] - c[i - 1])/(x[i] - x[i - 1])*0.5*((u - x[i - 1])/sqrt((u - x[i - 1])^2 + w[i - 1]^2)
        - (u - x[i])/sqrt((u - x[i])^2 + w[i]^2));
    end for;
    annotation(Inline=true, smoothOrder=1);
  end slope"""
