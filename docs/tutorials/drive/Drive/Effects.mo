within Drive;
package Effects "What the drive may have beyond its design"
  model GuidewayFriction "Dry friction of the guideway"
    extends Slots.PartialForce;
    parameter Real F_c(unit="N", min=0, max=500, nominal=50) = 0 "Friction force, 0 = off";
  equation
    f = -F_c*tanh(v/1e-3);
    annotation(__HydraulicTestBench(effect="axis.friction", slot="guideway"));
  end GuidewayFriction;

  model Incline "Weight of the carriage on an axis that is not level"
    extends Slots.PartialForce;
    parameter Real F_g(unit="N", min=-400, max=400, nominal=50) = 0 "Weight along the axis, 0 = off";
  equation
    f = -F_g;
    annotation(__HydraulicTestBench(effect="axis.incline", slot="guideway"));
  end Incline;

  model Cogging "Torque between the motor's magnets and its iron"
    extends Slots.PartialTorque;
    parameter Real T_c(unit="N.m", min=-1, max=1, nominal=0.1) = 0 "Amplitude, 0 = off";
    constant Integer periods = 12 "Periods in a turn";
  equation
    tau = T_c*sin(periods*phi);
    annotation(__HydraulicTestBench(effect="axis.cogging", slot="shaft"));
  end Cogging;

  model Forces "Two forces on the carriage at once"
    extends Slots.PartialForce;
    replaceable Slots.NoForce first constrainedby Slots.PartialForce;
    replaceable Slots.NoForce second constrainedby Slots.PartialForce;
  equation
    first.x = x;
    first.v = v;
    second.x = x;
    second.v = v;
    f = first.f + second.f;
    annotation(__HydraulicTestBench(pair="guideway"));
  end Forces;
end Effects;
