package Pair "A mass and a spring, cut between force and velocity: next to nothing to compute"
  model Mass "A mass that a force moves"
    parameter Real m(unit="kg") = 4;
    input Real F(unit="N", start=0);
    output Real v(unit="m/s", start=0, fixed=true);
  equation
    m*der(v) = F;
  end Mass;

  model Spring "A spring, stretched at the start"
    parameter Real k(unit="N/m") = 100;
    parameter Real x_start(unit="m") = 0.1;
    input Real v(unit="m/s", start=0);
    output Real F(unit="N");
    Real x(unit="m", start=x_start, fixed=true);
  equation
    der(x) = v;
    F = -k*x;
  end Spring;
end Pair;
