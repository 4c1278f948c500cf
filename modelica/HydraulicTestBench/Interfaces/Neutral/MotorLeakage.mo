within HydraulicTestBench.Interfaces.Neutral;
model MotorLeakage "No leakage"
  extends PartialMotorLeakage;
equation
  q_s = 0;
  q_L = 0;
  annotation(Documentation(info="<html>
<p>The base model's filling of the slot <code>Interfaces.PartialMotorLeakage</code>: exactly nothing. A compiler removes
it.</p>
<p><b>Source:</b> thesis Eq. 5.2 to 5.24, which have no such term.</p>
</html>"));
end MotorLeakage;
