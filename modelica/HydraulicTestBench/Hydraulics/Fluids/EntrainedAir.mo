within HydraulicTestBench.Hydraulics.Fluids;
model EntrainedAir "Oil with bubbles of air"
  extends Interfaces.PartialFluid;
  parameter Real eps(final unit="1", min=0, max=0.2, nominal=0.01) = 0.01 "Share of air at ambient pressure";
  constant Real n(final unit="1") = 1.4 "Polytropic exponent";
  constant Types.Pressure p_0 = 1.013e5 "Ambient pressure";
  constant Types.Pressure p_min = 1e3 "Floor of the absolute pressure";
protected
  Types.Pressure p_abs "Absolute pressure";
equation
  p_abs = max(p + p_0, p_min);
  beta_eff = beta/(1 + beta*eps*(p_0/p_abs)^(1/n)/(n*p_abs));
  annotation(Documentation(info="<html>
<p>1/&beta;<sub>eff</sub> = 1/&beta; + &epsilon; (p<sub>0</sub>/p)<sup>1/n</sup>/(n p), with p absolute: the law of
<code>Effects.OilAir</code>.</p>
<p><b>Source:</b> polytropic compression of the share &epsilon; of free air; goes into thesis Eq. 3.4.</p>
<p><b>Valid:</b> absolute pressures above p<sub>min</sub>.</p>
<p><b>Leaves out:</b> solution of the air, cavitation.</p>
</html>"));
end EntrainedAir;
