within HydraulicTestBench.Effects;
model ShaftFriction "Stiction and Coulomb friction of motors and shaft, thesis Eq. 5.38 (shaft.friction)"
  extends Interfaces.PartialShaftFriction;
  parameter Types.Torque tau_c(min=0, max=500, nominal=10) = 0 "Coulomb friction, 0 = off";
  parameter Types.Torque tau_s(min=0, max=500, nominal=50) = 0 "Stiction, 0 = off";
  parameter Types.AngularVelocity omega_0(min=0.1, max=100, nominal=10) = 10 "Speed over which stiction fades";
  parameter Real r(final unit="s/rad", min=0.1, max=1e3, nominal=10) = 10 "Steepness at standstill";
equation
  tau = Functions.frictionTorque(w, r, omega_0, tau_c, tau_s);
  annotation(__HydraulicTestBench(effect="shaft.friction", slot="shaftFriction"), Documentation(info="<html>
<p>The law is <code>Functions.frictionTorque</code>, beside the linear c&omega;. What the thesis identified for its
bench is in <code>Data.LoadCircuit</code>.</p>
<p><b>Source:</b> thesis Eq. 5.38.</p>
<p><b>Valid, leaves out:</b> see <code>Mechanics.Friction</code>.</p>
</html>"));
end ShaftFriction;
