within HydraulicTestBench.Interfaces.Neutral;
model ExternalLeakage "No flow from the chambers to the tank"
  extends PartialExternalLeakage;
equation
  q1 = 0;
  q2 = 0;
  annotation(Documentation(info="<html>
<p>The base model's filling of the slot <code>Interfaces.PartialExternalLeakage</code>: exactly nothing. A compiler
removes it.</p>
<p><b>Source:</b> thesis Eq. 3.1 to 3.20, which have no such term.</p>
</html>"));
end ExternalLeakage;
