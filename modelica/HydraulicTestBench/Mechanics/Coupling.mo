within HydraulicTestBench.Mechanics;
model Coupling "Shaft coupling that twists: spring and damper"
  extends Icons.Component;
  parameter Real k_t(final unit="N.m/rad", min=1, nominal=1e4) "Torsional stiffness";
  parameter Real d_t(final unit="N.m.s/rad", min=0, nominal=1) = 0 "Torsional damping";
  Interfaces.Flange_a flange_a "Drive side"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.Flange_b flange_b "Driven side"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  Types.Angle phi_rel "Twist";
  Types.AngularVelocity w_rel "Rate of the twist";
  Types.Torque tau "Torque from a to b's side that resists the twist";
equation
  phi_rel = flange_b.phi - flange_a.phi;
  w_rel = der(flange_b.phi) - der(flange_a.phi);
  tau = k_t*phi_rel + d_t*w_rel;
  flange_b.tau = tau;
  flange_a.tau = -tau;
  annotation(Documentation(info="<html>
<p>&tau; = k<sub>t</sub>(&phi;<sub>b</sub> - &phi;<sub>a</sub>) + d<sub>t</sub>(&omega;<sub>b</sub> -
&omega;<sub>a</sub>). A rigid coupling needs no component: connect the flanges.</p>
<p><b>Source:</b> thesis Fig. 5.1 and 5.12, where the coupling is rigid.</p>
<p><b>Valid:</b> small twists.</p>
<p><b>Leaves out:</b> play, inertia of the coupling.</p>
</html>"));
end Coupling;
