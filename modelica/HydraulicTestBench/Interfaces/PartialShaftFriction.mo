within HydraulicTestBench.Interfaces;
partial model PartialShaftFriction "Slot for friction of a shaft"
  extends Icons.Slot;
  Flange_a flange "Shaft"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Types.AngularVelocity w "Speed";
  Types.Torque tau "Friction torque, with the sign of w";
equation
  w = der(flange.phi);
  flange.tau = tau;
  annotation(Documentation(info="<html>
<p>From the shaft to the ground, beside the linear c&omega;. The law is one equation that gives tau from w; in the base
model tau = 0.</p>
<p><b>Source:</b> thesis Eq. 5.11 and 5.24, beside &omega;c.</p>
<p><b>Used by:</b> <code>shaftFriction</code> of <code>LoadCircuit.OpenTestBench</code>.</p>
</html>"));
end PartialShaftFriction;
