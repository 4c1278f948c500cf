package Toy
  partial model PartialForce
    input Real x(unit="m");
    input Real v(unit="m/s");
    output Real f(unit="N");
  end PartialForce;
  model NoForce extends PartialForce; equation f = 0; end NoForce;
  model Rubbing "Dry friction" extends PartialForce;
    parameter Real F_c(unit="N", min=0, max=5, nominal=0.3) = 0 "0 = off";
  equation
    f = -F_c*tanh(v/0.02);
    annotation(__HydraulicTestBench(effect="toy.friction", slot="force"));
  end Rubbing;
  model Hardening "Cubic spring" extends PartialForce;
    parameter Real k_3(unit="N/m3", min=0, max=100, nominal=5) = 0 "0 = off";
  equation
    f = -k_3*x^3;
    annotation(__HydraulicTestBench(effect="toy.hardening", slot="force"));
  end Hardening;
  model Mass
    parameter Real m(unit="kg", min=0.5, max=5, nominal=1) = 1;
    parameter Real d(unit="N.s/m", min=0, max=10, nominal=1) = 0.8;
    parameter Real k(unit="N/m", min=1, max=100, nominal=10) = 20;
    input Real F(unit="N", start=0);
    output Real x(unit="m", start=0, fixed=true);
    output Real v(unit="m/s", start=0, fixed=true);
    replaceable NoForce force constrainedby PartialForce;
  equation
    force.x = x;
    force.v = v;
    der(x) = v;
    m*der(v) = F - d*v - k*x + force.f;
  end Mass;
end Toy;
