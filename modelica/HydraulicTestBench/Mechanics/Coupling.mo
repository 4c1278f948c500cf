within HydraulicTestBench.Mechanics;
model Coupling "Shaft coupling that twists: spring and damper"
  extends Icons.Component;
  extends Interfaces.PartialCoupling;
  parameter Real k_t(final unit="N.m/rad", min=1, nominal=1e4) "Torsional stiffness";
  parameter Real d_t(final unit="N.m.s/rad", min=0, nominal=1) = 0 "Torsional damping";
equation
  tau = k_t*phi_rel + d_t*(der(flange_b.phi) - der(flange_a.phi));
  annotation(Documentation(info="<html>
<p>&tau; = k<sub>t</sub>(&phi;<sub>b</sub> - &phi;<sub>a</sub>) + d<sub>t</sub>(&omega;<sub>b</sub> -
&omega;<sub>a</sub>). A rigid coupling needs no component: connect the flanges.</p>
<p><b>Source:</b> thesis Fig. 5.1 and 5.12, where the coupling is rigid.</p>
<p><b>Valid:</b> small twists.</p>
<p><b>Leaves out:</b> play, inertia of the coupling.</p>
</html>"));
end Coupling;
