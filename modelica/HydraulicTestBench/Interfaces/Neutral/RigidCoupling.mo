within HydraulicTestBench.Interfaces.Neutral;
model RigidCoupling "Rigid coupling"
  extends PartialCoupling;
equation
  phi_rel = 0;
  annotation(Documentation(info="<html>
<p>The base model's filling of the slot <code>Interfaces.PartialCoupling</code>: exactly nothing. A compiler removes
it.</p>
<p><b>Source:</b> thesis Eq. 5.2 to 5.24, which have no such term.</p>
</html>"));
end RigidCoupling;
