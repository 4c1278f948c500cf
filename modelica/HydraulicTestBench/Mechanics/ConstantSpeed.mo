within HydraulicTestBench.Mechanics;
model ConstantSpeed "Drive that holds its speed whatever the torque"
  extends Icons.Component;
  parameter Types.AngularVelocity w "Speed";
  Interfaces.Flange_b flange "Shaft"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  Types.Angle phi(start=0, fixed=true, stateSelect=StateSelect.always) "Angle";
  Types.Torque tau "Torque delivered";
equation
  der(phi) = w;
  flange.phi = phi;
  tau = -flange.tau;
  annotation(Documentation(info="<html>
<p>An induction motor at its speed, without slip.</p>
<p>An <code>Inertia</code> on its shaft takes its start from here: <code>Inertia rotor(J=0.01, phi(fixed=false),
w(fixed=false))</code>.</p>
<p><b>Source:</b> thesis Section 3.4.4, 1450 rpm.</p>
<p><b>Leaves out:</b> slip: the flow measured in Section 4.1 hints at a speed somewhat above 1450 rpm.</p>
</html>"));
end ConstantSpeed;
