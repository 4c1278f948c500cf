within HydraulicTestBench.Interfaces.Neutral;
model InternalLeakage "No further flow between the chambers"
  extends PartialTwoPort;
equation
  q = 0;
  annotation(Documentation(info="<html>
<p>The base model's filling of the slot <code>Interfaces.PartialTwoPort</code>: exactly nothing. A compiler removes
it.</p>
<p><b>Source:</b> thesis Eq. 3.1 to 3.20, which have no such term.</p>
</html>"));
end InternalLeakage;
