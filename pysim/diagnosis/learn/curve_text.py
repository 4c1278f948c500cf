"""The curve of `curve.py` and its derivative as Modelica functions, to stand in a class."""

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
