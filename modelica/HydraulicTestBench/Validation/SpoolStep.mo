within HydraulicTestBench.Validation;
model SpoolStep "Step response of the valve spool"
  extends Icons.Example;
  Pump.SecondOrderSpool spool(omega_v=2*Constants.pi*28.05, zeta_v=0.82031) "Spool"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Types.SpoolPosition u_exact "Closed form";
  Types.SpoolPosition error = spool.u - u_exact "Difference from the closed form";
protected
  final parameter Real sigma(final unit="1/s") = spool.zeta_v*spool.omega_v "Decay rate";
  final parameter Types.AngularVelocity omega_d = spool.omega_v*sqrt(1 - spool.zeta_v^2) "Damped frequency";
equation
  spool.u_ref = 1;
  u_exact = 1 - exp(-sigma*time)*(cos(omega_d*time) + sigma/omega_d*sin(omega_d*time));
  annotation(
    experiment(StartTime=0, StopTime=0.1, Interval=0.0005, Tolerance=1e-8),
    Documentation(info="<html>
<p>Second order lag below critical damping, with the free set's valve.</p>
<p><b>Source:</b> thesis Eq. 3.19, Table 4.6; textbook step response.</p>
</html>"));
end SpoolStep;
