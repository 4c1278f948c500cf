within HydraulicTestBench.Interfaces.Neutral;
model MotorLoss "No torque is lost in the motors"
  extends PartialMotorLoss;
equation
  tau_s = 0;
  tau_L = 0;
  annotation(Documentation(info="<html>
<p>The base model's filling of the slot <code>Interfaces.PartialMotorLoss</code>: exactly nothing. A compiler removes
it.</p>
<p><b>Source:</b> thesis Eq. 5.2 to 5.24, which have no such term.</p>
</html>"));
end MotorLoss;
