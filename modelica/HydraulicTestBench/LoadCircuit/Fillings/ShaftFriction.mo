within HydraulicTestBench.LoadCircuit.Fillings;
model ShaftFriction "Stiction and Coulomb friction of motors and shaft, thesis Eq. 5.38"
  extends Interfaces.PartialShaftFriction;
  parameter Types.Torque tau_c(min=0, max=500, nominal=10) = 0 "Coulomb friction, 0 = off";
  parameter Types.Torque tau_s(min=0, max=500, nominal=50) = 0 "Stiction, 0 = off";
  parameter Types.AngularVelocity omega_0(min=0.1, max=100, nominal=10) = 8.3593 "Speed over which stiction fades";
  parameter Real r(final unit="s/rad", min=0.1, max=1e3, nominal=10) = 13.8806 "Steepness at standstill";
equation
  tau = Functions.frictionTorque(w, r, omega_0, tau_c, tau_s);
  annotation(Documentation(info="<html>
<p>The law is <code>Functions.frictionTorque</code>, beside the linear c&omega;.</p>
<p><b>Source:</b> thesis Eq. 5.38, Table 6.2.</p>
<p><b>Valid, leaves out:</b> see <code>Mechanics.Friction</code>.</p>
</html>"));
end ShaftFriction;
