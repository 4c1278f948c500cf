within HydraulicTestBench.Effects;
model MotorLeakage "Laminar leakage across each motor of the test bench (motor.leakage)"
  extends Interfaces.PartialMotorLeakage;
  parameter Real C_m(final unit="m3/(s.Pa)", min=0, max=1e-10, nominal=1e-12) = 0
    "Flow over pressure difference, 0 = off";
equation
  q_s = C_m*p_s;
  q_L = C_m*p_L;
  annotation(__HydraulicTestBench(effect="motor.leakage", slot="motorLeakage"), Documentation(info="<html>
<p>q = C<sub>m</sub> p in both motors.</p>
<p><b>Source:</b> this library; beside thesis Eq. 5.7 and 5.19.</p>
<p><b>Valid:</b> laminar gaps.</p>
<p><b>Leaves out:</b> leakage to the drain.</p>
</html>"));
end MotorLeakage;
