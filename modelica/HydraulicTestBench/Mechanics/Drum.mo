within HydraulicTestBench.Mechanics;
model Drum "Wire drum: rotation to translation"
  extends Icons.Component;
  parameter Types.Length r_d(min=1e-3) "Radius at which the wire leaves";
  Interfaces.Flange_a shaft "Shaft"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.TranslationFlange_b wire "End of the wire, moves with positive rotation towards positive s"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
initial equation
  wire.s = r_d*shaft.phi;
equation
  der(wire.s) = r_d*der(shaft.phi);
  shaft.tau = -r_d*wire.f;
  annotation(Documentation(info="<html>
<p>s = r &phi;, and the torque of the wire's force on the shaft. No power is lost.
The position of the wire's end is a state that begins at r &phi;, so that what joins it, such as a <code>Wire</code>,
has its velocity without any equation being differentiated.</p>
<p><b>Source:</b> thesis Section 5.7.</p>
<p><b>Valid:</b> one layer of wire.</p>
<p><b>Leaves out:</b> inertia (add an <code>Inertia</code>), layers, that wire on the drum is no longer in the
water.</p>
</html>"));
end Drum;
