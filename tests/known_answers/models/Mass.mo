package Mass "A mass on a spring and a damper, and what may act on it besides"
  partial model PartialForce "What acts on the mass besides spring and damper"
    input Real x(unit="m") "Position";
    input Real v(unit="m/s") "Velocity";
    output Real f(unit="N") "Force, positive towards positive x";
  end PartialForce;

  model NoForce "Nothing"
    extends PartialForce;
  equation
    f = 0;
  end NoForce;

  model Friction "Dry friction"
    extends PartialForce;
    parameter Real F_c(unit="N", min=0, max=5, nominal=0.3) = 0 "Friction force, 0 = off";
  equation
    f = -F_c*tanh(v/0.02);
    annotation(__HydraulicTestBench(effect="mass.friction", slot="force"));
  end Friction;

  model StickSlip "Dry friction that is larger near standstill"
    extends PartialForce;
    parameter Real F_c(unit="N", min=0, max=5, nominal=0.3) = 0 "Friction force at speed, 0 = off";
    parameter Real F_d(unit="N", min=0, max=5, nominal=0.3) = 0 "More near standstill, 0 = off";
  equation
    f = -tanh(v/0.005)*(F_c + F_d*exp(-abs(v)/0.05));
    annotation(__HydraulicTestBench(effect="mass.stick_slip", slot="force"));
  end StickSlip;

  model Drag "Drag with the square of speed"
    extends PartialForce;
    parameter Real c_2(unit="N.s2/m2", min=0, max=50, nominal=2) = 0 "Drag coefficient, 0 = off";
  equation
    f = -c_2*v*abs(v);
    annotation(__HydraulicTestBench(effect="mass.drag", slot="force"));
  end Drag;

  model Hardening "Cubic spring"
    extends PartialForce;
    parameter Real k_3(unit="N/m3", min=0, max=2000, nominal=100) = 0 "Cubic stiffness, 0 = off";
  equation
    f = -k_3*x^3;
    annotation(__HydraulicTestBench(effect="mass.hardening", slot="force"));
  end Hardening;

  model Bias "Constant force"
    extends PartialForce;
    parameter Real F_b(unit="N", min=-5, max=5, nominal=0.3) = 0 "Force, 0 = off";
  equation
    f = F_b;
    annotation(__HydraulicTestBench(effect="mass.bias", slot="force"));
  end Bias;

  model Both "Two forces at once"
    extends PartialForce;
    replaceable NoForce first constrainedby PartialForce;
    replaceable NoForce second constrainedby PartialForce;
  equation
    first.x = x;
    first.v = v;
    second.x = x;
    second.v = v;
    f = first.f + second.f;
    annotation(__HydraulicTestBench(pair="force"));
  end Both;

  model Design "The mass as designed"
    parameter Real m(unit="kg", min=0.5, max=5, nominal=1) = 1 "Mass";
    parameter Real d(unit="N.s/m", min=0, max=10, nominal=1) = 2 "Damping";
    parameter Real k(unit="N/m", min=1, max=200, nominal=40) = 40 "Stiffness";
    input Real F(unit="N", start=0) "Force";
    output Real x(unit="m", start=0, fixed=true) "Position";
    Real v(unit="m/s", start=0, fixed=true) "Velocity";
    replaceable NoForce force constrainedby PartialForce;
  equation
    force.x = x;
    force.v = v;
    der(x) = v;
    m*der(v) = F - d*v - k*x + force.f;
  end Design;
end Mass;
