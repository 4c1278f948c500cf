package Cart "A cart on a spring with room for a force that nobody has modelled"
  partial model PartialForce
    input Real x(unit="m");
    input Real v(unit="m/s");
    output Real f(unit="N");
  end PartialForce;
  model NoForce extends PartialForce; equation f = 0; end NoForce;
  model Rubbing "Dry friction"
    extends PartialForce;
    parameter Real F_c(unit="N", min=0, max=5, nominal=0.3) = 0 "0 = off";
  equation
    f = -F_c*tanh(v/0.02);
    annotation(__HydraulicTestBench(effect="cart.friction", slot="force"));
  end Rubbing;
  model Bias "Constant force"
    extends PartialForce;
    parameter Real F_b(unit="N", min=-5, max=5, nominal=0.3) = 0 "0 = off";
  equation
    f = F_b;
    annotation(__HydraulicTestBench(effect="cart.bias", slot="force"));
  end Bias;
  model Mass
    parameter Real m(unit="kg", min=0.5, max=5, nominal=1) = 1;
    parameter Real d(unit="N.s/m", min=0, max=10, nominal=1) = 0.8;
    parameter Real k(unit="N/m", min=1, max=100, nominal=10) = 20;
    input Real F(unit="N", start=0);
    output Real x(unit="m", start=0, fixed=true, nominal=0.1);
    output Real v(unit="m/s", start=0, fixed=true, nominal=1);
    replaceable NoForce force constrainedby PartialForce;
  equation
    force.x = x;
    force.v = v;
    der(x) = v;
    m*der(v) = F - d*v - k*x + force.f;
  end Mass;
  model Truth "Where the logs come from"
    extends Mass(m=1.05, d=0.75, k=21, redeclare Rubbing force(F_c=0.4));
  end Truth;
end Cart;
