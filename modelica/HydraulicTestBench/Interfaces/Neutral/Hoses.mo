within HydraulicTestBench.Interfaces.Neutral;
model Hoses "Nothing beside the dead volumes"
  extends PartialHoses;
equation
  port_sA.q = 0;
  port_sB.q = 0;
  port_LA.q = 0;
  port_LB.q = 0;
  annotation(Documentation(info="<html>
<p>The base model's filling of the slot <code>Interfaces.PartialHoses</code>: exactly nothing. A compiler removes
it.</p>
<p><b>Source:</b> thesis Eq. 5.2 to 5.24, which have no such term.</p>
</html>"));
end Hoses;
