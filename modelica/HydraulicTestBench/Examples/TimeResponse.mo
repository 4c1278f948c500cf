within HydraulicTestBench.Examples;
model TimeResponse "Response of the pump to three growing sines, free parameter set"
  extends Icons.Example;
  Sources.GrowingSines command "Command"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Pump.FreeGreyBox pump "Pump"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
equation
  connect(command.y, pump.alphaCMD);
  connect(command.y_t, pump.alphaCMD_t);
  annotation(
    experiment(StartTime=0, StopTime=5, Interval=0.002, Tolerance=1e-8),
    Documentation(info="<html>
<p>Slow and fast motion over most of the stroke: plot angle, spool position and the two chamber pressures.</p>
<p><b>Source:</b> thesis Eq. 3.1 to 3.20, Table 4.6.</p>
</html>"));
end TimeResponse;
