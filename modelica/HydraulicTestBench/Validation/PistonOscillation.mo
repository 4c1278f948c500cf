within HydraulicTestBench.Validation;
model PistonOscillation "Free oscillation of the control piston"
  extends Icons.Example;
  Pump.ControlPiston piston(
    A_p=401.33e-6, V_0=0.0607e-3, m_eff=62.384, k=13.445e3, b=200, xpMAX=23e-3, xpMIN=-23e-3,
    x(start=5e-3)) "Piston, released at 5 mm"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Hydraulics.Tank tank1 "No pressure in chamber 1"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
  Hydraulics.Tank tank2 "No pressure in chamber 2"
    annotation(Placement(transformation(extent={{40, 20}, {80, 60}})));
  Types.Length x_exact "Closed form";
  Types.Length error = piston.x - x_exact "Difference from the closed form";
protected
  final parameter Real sigma(final unit="1/s") = piston.b/(2*piston.m_eff) "Decay rate";
  final parameter Types.AngularVelocity omega_d = sqrt(piston.k/piston.m_eff - sigma^2) "Damped frequency";
equation
  connect(tank1.port, piston.port_1);
  connect(tank2.port, piston.port_2);
  piston.f = 0;
  x_exact = 5e-3*exp(-sigma*time)*(cos(omega_d*time) + sigma/omega_d*sin(omega_d*time));
  annotation(
    experiment(StartTime=0, StopTime=2, Interval=0.005, Tolerance=1e-8),
    Documentation(info="<html>
<p>Mass, spring and damper without oil, damping lowered so that it swings.</p>
<p><b>Source:</b> thesis Eq. 3.9; textbook free response.</p>
</html>"));
end PistonOscillation;
