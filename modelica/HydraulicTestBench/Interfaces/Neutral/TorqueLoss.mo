within HydraulicTestBench.Interfaces.Neutral;
model TorqueLoss "No torque is lost"
  extends PartialTorqueLoss;
equation
  tau = 0;
  annotation(Documentation(info="<html>
<p>The base model's filling of the slot <code>Interfaces.PartialTorqueLoss</code>: exactly nothing. A compiler
removes it.</p>
<p><b>Source:</b> thesis Eq. 5.8 and 5.20, which have no such term.</p>
</html>"));
end TorqueLoss;
