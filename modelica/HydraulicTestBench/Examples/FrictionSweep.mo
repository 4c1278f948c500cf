within HydraulicTestBench.Examples;
model FrictionSweep "Slow swing of the shaft through all speeds, to see its friction"
  extends Icons.Example;
  Mechanics.DrivenShaft bench "Shaft and drive"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}})));
equation
  bench.omega_ref = 40*sin(2*Constants.pi*time/20);
  bench.T_L = 0;
  annotation(
    experiment(StartTime=0, StopTime=20, Interval=0.004, Tolerance=1e-6),
    Documentation(info="<html>
<p>Plot <code>bench.T_s</code> over <code>bench.omega</code>: stiction, its fall to Coulomb friction, both
directions. Then over <code>bench.omega_s</code>, what the pulse sensor makes of it.</p>
<p><b>Source:</b> thesis Section 6.2, Table 6.2.</p>
</html>"));
end FrictionSweep;
