within HydraulicTestBench.Effects;
model LeakageLaminar "Laminar leakage between the chambers (leakage.laminar)"
  extends Interfaces.PartialTwoPort;
  parameter Real C_l(final unit="m3/(s.Pa)", min=0, max=2e-11, nominal=1e-12) = 0
    "Flow over pressure difference, 0 = off";
equation
  q = C_l*dp;
  annotation(__HydraulicTestBench(effect="leakage.laminar", slot="internalLeakage"), Documentation(info="<html>
<p>q = C<sub>l</sub> (p<sub>1</sub> - p<sub>2</sub>).</p>
<p><b>Source:</b> this library; beside thesis Eq. 3.6.</p>
<p><b>Valid:</b> laminar gaps.</p>
<p><b>Leaves out:</b> change of viscosity with temperature.</p>
</html>"));
end LeakageLaminar;
