within HydraulicTestBench.Examples;
model SteppedSine "One frequency response test of the pump, free parameter set"
  extends Icons.Example;
  Sources.SteppedSine command(offset=25, amplitude=10, f=5) "Command of the test"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Pump.FreeGreyBox pump "Pump"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
equation
  connect(command.y, pump.alphaCMD);
  connect(command.y_t, pump.alphaCMD_t);
  annotation(
    experiment(StartTime=0, StopTime=4, Interval=0.001, Tolerance=1e-6),
    Documentation(info="<html>
<p>Offset 25 percent, amplitude 10 percent, 5 Hz: plot <code>pump.alphaCMD</code> and <code>pump.alphaPercent</code>.
The
response lags the command by about 43 degrees at 0.93 of its amplitude.</p>
<p><b>Source:</b> thesis Section 2.1.1, Table 4.6.</p>
</html>"));
end SteppedSine;
