within HydraulicTestBench.Mechanics;
model Friction "Friction of a shaft in its bearings and seals, thesis Eq. 5.38"
  extends Icons.Component;
  parameter Real r(final unit="s/rad", min=0.1, max=1e3, nominal=10) "Steepness at standstill";
  parameter Types.AngularVelocity omega_0(min=0.1, max=100) "Speed over which stiction fades";
  parameter Types.Torque tau_c(min=0, max=500) "Coulomb friction, what is left at high speed";
  parameter Types.Torque tau_s(min=0, max=500) "Stiction, the largest friction near standstill";
  Interfaces.Flange_a flange "Shaft"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Types.AngularVelocity w "Speed";
  Types.Torque tau_f "Friction torque, against the motion";
equation
  w = der(flange.phi);
  tau_f = Functions.frictionTorque(w, r, omega_0, tau_c, tau_s);
  flange.tau = tau_f;
  annotation(Documentation(info="<html>
<p>From the shaft to the ground: the law is <code>Functions.frictionTorque</code>.</p>
<p><b>Source:</b> thesis Eq. 5.38, Fig. 5.11.</p>
<p><b>Valid:</b> steady friction. Near standstill the shaft creeps at up to atanh(T/&tau;<sub>s</sub>)/r where a real
one stands.</p>
<p><b>Leaves out:</b> sticking, lag of friction behind speed, viscous friction, temperature.</p>
</html>"));
end Friction;
