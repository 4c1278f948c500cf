within HydraulicTestBench.Interfaces.Neutral;
model Supply "Supply of constant pressure"
  extends PartialSupply;
equation
  dp = 0;
  annotation(Documentation(info="<html>
<p>The base model's filling of the slot <code>Interfaces.PartialSupply</code>: exactly nothing. A compiler removes
it.</p>
<p><b>Source:</b> thesis Eq. 3.1 to 3.20, which have no such term.</p>
</html>"));
end Supply;
