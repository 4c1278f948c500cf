within HydraulicTestBench.Effects;
model LeakageExternal "Laminar leakage of each chamber to the tank (leakage.external)"
  extends Interfaces.PartialExternalLeakage;
  parameter Real C_e(final unit="m3/(s.Pa)", min=0, max=2e-11, nominal=1e-12) = 0 "Flow over pressure, 0 = off";
equation
  q1 = C_e*p1;
  q2 = C_e*p2;
  annotation(__HydraulicTestBench(effect="leakage.external", slot="externalLeakage"), Documentation(info="<html>
<p>Each chamber leaks C<sub>e</sub> p to the tank.</p>
<p><b>Source:</b> this library; goes into thesis Eq. 3.4 and 3.5.</p>
<p><b>Valid:</b> laminar gaps.</p>
<p><b>Leaves out:</b> change of viscosity with temperature.</p>
</html>"));
end LeakageExternal;
