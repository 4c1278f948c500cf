within HydraulicTestBench.Hydraulics;
model Volume "Oil in a rigid volume, thesis Eq. 3.4"
  extends Icons.Component;
  parameter Types.Volume V(min=1e-9) "Volume";
  parameter Types.BulkModulus beta "Oil stiffness";
  parameter Types.Pressure p_start = 0 "Pressure at the start";
  Interfaces.Port_a port_a "One end"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.Port_b port_b "The other end, at the same pressure"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  replaceable Fluids.ConstantStiffness fluid(beta=beta) constrainedby Interfaces.PartialFluid(beta=beta)
    "Stiffness of the oil over pressure"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-12, -62}, {12, -38}})));
  Types.Pressure p(start=p_start, fixed=true, stateSelect=StateSelect.prefer) "Pressure";
equation
  port_a.p = p;
  port_b.p = p;
  fluid.p = p;
  der(p) = fluid.beta_eff/V*(port_a.q + port_b.q);
  annotation(Documentation(info="<html>
<p>dp/dt = &beta;<sub>eff</sub>(p)/V &Sigma;Q. Where the volume changes, <code>Chamber</code> is the class to
take.</p>
<p>It starts at <code>p_start</code>. Joined directly to a second volume that would be one start too many:
<code>p(fixed=false)</code> at one of the two takes the start of the other.</p>
<p><b>Source:</b> thesis Eq. 3.4 at rest, 5.10.</p>
<p><b>Valid:</b> sizes well below a wave length, c/f.</p>
<p><b>Leaves out:</b> cavitation (the pressure may fall below vacuum), temperature, waves; elastic walls are in
<code>Hose</code>.</p>
</html>"));
end Volume;
