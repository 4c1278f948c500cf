within HydraulicTestBench.Interfaces;
partial model PartialCoupling "Slot for the coupling between two shafts"
  extends Icons.Slot;
  Flange_a flange_a "Drive side"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Flange_b flange_b "Driven side"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  Types.Angle phi_rel "Twist";
  Types.Torque tau "Torque that resists the twist";
equation
  phi_rel = flange_b.phi - flange_a.phi;
  flange_b.tau = tau;
  flange_a.tau = -tau;
  annotation(Documentation(info="<html>
<p>The law is one equation between phi_rel and tau; in the base model phi_rel = 0.</p>
<p><b>Source:</b> thesis Fig. 5.12.</p>
<p><b>Used by:</b> <code>coupling</code> of <code>LoadCircuit.OpenTestBench</code>, <code>Mechanics.Coupling</code>.</p>
</html>"));
end PartialCoupling;
