within HydraulicTestBench.Mechanics;
model TorqueSensor "Ideal torque sensor between two shafts"
  extends Icons.Component;
  Interfaces.Flange_a flange_a "Drive side"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.Flange_b flange_b "Driven side"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  Interfaces.RealOutput tau(unit="N.m") "Torque that goes from flange_a to flange_b"
    annotation(Placement(transformation(extent={{-10, 100}, {10, 120}})));
equation
  flange_a.phi = flange_b.phi;
  flange_a.tau + flange_b.tau = 0;
  tau = flange_a.tau;
  annotation(Documentation(info="<html>
<p>Reads the torque through a rigid connection.</p>
<p><b>Source:</b> this library; the thesis infers torques from pressures (Eq. 5.8, 5.20).</p>
<p><b>Leaves out:</b> twist and error of a real one.</p>
</html>"));
end TorqueSensor;
