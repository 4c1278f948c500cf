within HydraulicTestBench.Interfaces.Neutral;
model PistonForce "No further force"
  extends PartialPistonForce;
equation
  f = 0;
  annotation(Documentation(info="<html>
<p>The base model's filling of the slot <code>Interfaces.PartialPistonForce</code>: exactly nothing. A compiler
removes it.</p>
<p><b>Source:</b> thesis Eq. 3.1 to 3.20, which have no such term.</p>
</html>"));
end PistonForce;
