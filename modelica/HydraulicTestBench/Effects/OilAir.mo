within HydraulicTestBench.Effects;
model OilAir "Entrained air in the chambers (oil.air)"
  extends Interfaces.PartialCompressibility;
  parameter Real eps(final unit="1", min=0, max=0.2, nominal=0.01) = 0 "Share of air at ambient pressure, 0 = off";
  constant Real n(final unit="1") = 1.4 "Polytropic exponent";
  constant Types.Pressure p_0 = 1.013e5 "Ambient pressure";
  constant Types.Pressure p_min = 1e3 "Floor of the absolute pressure";
protected
  Types.Pressure absolute1 "Absolute pressure of chamber 1";
  Types.Pressure absolute2 "Absolute pressure of chamber 2";
equation
  kappa1 = eps*(p_0/absolute1)^(1/n)/(n*absolute1);
  kappa2 = eps*(p_0/absolute2)^(1/n)/(n*absolute2);
  absolute1 = max(p1 + p_0, p_min);
  absolute2 = max(p2 + p_0, p_min);
  annotation(__HydraulicTestBench(effect="oil.air", slot="oil"), Documentation(info="<html>
<p>1/&beta;<sub>eff</sub> = 1/&beta; + &epsilon; (p<sub>0</sub>/p)<sup>1/n</sup>/(n p), with p the absolute pressure
of each chamber.</p>
<p><b>Source:</b> this library; goes into thesis Eq. 3.4 and 3.5.</p>
<p><b>Valid:</b> absolute pressures above p<sub>min</sub>.</p>
<p><b>Leaves out:</b> solution of the air, cavitation.</p>
</html>"));
end OilAir;
