within HydraulicTestBench.Mechanics;
model Inertia "Rotating mass"
  extends Icons.Component;
  parameter Types.MomentOfInertia J "Moment of inertia";
  Interfaces.Flange_a flange_a "Drive side"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.Flange_b flange_b "Driven side"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  Types.Angle phi(start=0, fixed=true, stateSelect=StateSelect.prefer) "Angle";
  Types.AngularVelocity w(start=0, fixed=true, stateSelect=StateSelect.prefer) "Speed";
  Types.AngularAcceleration a "Acceleration";
equation
  flange_a.phi = phi;
  flange_b.phi = phi;
  der(phi) = w;
  der(w) = a;
  J*a = flange_a.tau + flange_b.tau;
  annotation(Documentation(info="<html>
<p>J &alpha; = &tau;<sub>a</sub> + &tau;<sub>b</sub>, with both torques positive into the mass.</p>
<p>It starts at angle 0 and at rest unless <code>phi(start=...)</code> and <code>w(start=...)</code> say otherwise. On a
shaft that starts elsewhere already, at a drive or rigidly at a second mass, that would be one start too many:
<code>Inertia rotor(J=0.01, phi(fixed=false), w(fixed=false))</code> takes the start of the other.</p>
<p><b>Source:</b> thesis Eq. 5.40.</p>
<p><b>Valid:</b> a rigid shaft.</p>
<p><b>Leaves out:</b> torsion.</p>
</html>"));
end Inertia;
