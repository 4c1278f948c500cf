within HydraulicTestBench.Hydraulics.Fluids;
model RisingStiffness "Oil whose stiffness rises in proportion to pressure"
  extends Interfaces.PartialFluid;
  parameter Real beta_p(final unit="1", min=0, max=30, nominal=10) = 10 "Rise of stiffness over rise of pressure";
  constant Types.BulkModulus beta_min = 1e7 "Floor of the stiffness, far below vacuum";
equation
  beta_eff = max(beta + beta_p*p, beta_min);
  annotation(Documentation(info="<html>
<p>&beta;<sub>eff</sub> = &beta; + &beta;<sub>p</sub> p, the first two terms of the stiffness of a pure mineral oil. A
rise of 10 adds 0.35 GPa at 350 bar to the 1.4 GPa at none.</p>
<p><b>Source:</b> H. E. Merritt, Hydraulic Control Systems, Chapter 2; goes into thesis Eq. 3.4.</p>
<p><b>Valid:</b> up to some 400 bar.</p>
<p><b>Leaves out:</b> air, temperature.</p>
</html>"));
end RisingStiffness;
