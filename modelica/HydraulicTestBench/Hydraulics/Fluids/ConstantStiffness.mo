within HydraulicTestBench.Hydraulics.Fluids;
model ConstantStiffness "Oil of the same stiffness at every pressure"
  extends Interfaces.PartialFluid;
equation
  beta_eff = beta;
  annotation(Documentation(info="<html>
<p>&beta;<sub>eff</sub> = &beta;.</p>
<p><b>Source:</b> thesis Eq. 3.4, Table 5.</p>
<p><b>Leaves out:</b> air and the rise of stiffness with pressure.</p>
</html>"));
end ConstantStiffness;
