within HydraulicTestBench.Examples;
model FullStroke "Steps of the command from stop to stop, locked parameter set"
  extends Icons.Example;
  Sources.Step forth(height=100, t_step=0.1) "Step to the positive stop"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Sources.Step back(height=-200, t_step=0.6) "Step to the negative stop"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
  Pump.LockedGreyBox pump "Pump"
    annotation(Placement(transformation(extent={{40, 20}, {80, 60}})));
equation
  pump.alphaCMD = forth.y + back.y;
  pump.alphaCMD_t = 0;
  annotation(
    experiment(StartTime=0, StopTime=1.2, Interval=0.001, Tolerance=1e-6),
    Documentation(info="<html>
<p>The piston meets its end stops, and the volume of a chamber its floor: with this parameter set V<sub>0</sub> is less
than A<sub>p</sub>L/2. Everything stays finite.</p>
<p><b>Source:</b> thesis Table 4.5, Eq. 3.5.</p>
</html>"));
end FullStroke;
