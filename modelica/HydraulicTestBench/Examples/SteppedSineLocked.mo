within HydraulicTestBench.Examples;
model SteppedSineLocked "One frequency response test of the pump, locked parameter set"
  extends Icons.Example;
  Sources.SteppedSine command(offset=25, amplitude=10, f=5) "Command of the test"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Pump.LockedGreyBox pump "Pump"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
equation
  connect(command.y, pump.alphaCMD);
  connect(command.y_t, pump.alphaCMD_t);
  annotation(
    experiment(StartTime=0, StopTime=4, Interval=0.001, Tolerance=1e-6),
    Documentation(info="<html>
<p>As <code>SteppedSine</code>, with the parameters of Table 4.5.</p>
<p><b>Source:</b> thesis Section 2.1.1, Table 4.5.</p>
</html>"));
end SteppedSineLocked;
