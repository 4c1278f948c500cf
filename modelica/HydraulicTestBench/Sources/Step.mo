within HydraulicTestBench.Sources;
block Step "Step of the command"
  extends Icons.Component;
  parameter Types.Percent height = 50 "Height";
  parameter Real t_step(final unit="s") = 0.1 "When it comes";
  Interfaces.RealOutput y(unit="%") "Command"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
equation
  y = if time < t_step then 0 else height;
  annotation(Documentation(info="<html>
<p>Zero, then <code>height</code>. Its rate is not offered: it is infinite at one instant.</p>
<p><b>Source:</b> this library.</p>
<p><b>Leaves out:</b> the slope a real command has.</p>
</html>"));
end Step;
