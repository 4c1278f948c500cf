within HydraulicTestBench.Validation;
model TwoMassTwist "Two masses on a coupling swing against each other"
  extends Icons.Example;
  Mechanics.Inertia left(J=0.05, phi(start=0.01)) "Mass, twisted at the start"
    annotation(Placement(transformation(extent={{-80, -20}, {-40, 20}})));
  Mechanics.Coupling coupling(k_t=5000, d_t=0.3) "Coupling"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}})));
  Mechanics.Inertia right(J=0.2) "Mass at rest"
    annotation(Placement(transformation(extent={{40, -20}, {80, 20}})));
  Types.Angle twist_exact "Closed form";
  Types.Angle error = coupling.phi_rel - twist_exact "Difference from the closed form";
  Real momentum(final unit="N.m.s") = left.J*left.w + right.J*right.w "Stays zero";
protected
  final parameter Types.MomentOfInertia J_red = left.J*right.J/(left.J + right.J) "Reduced inertia";
  final parameter Real sigma(final unit="1/s") = coupling.d_t/(2*J_red) "Decay rate";
  final parameter Types.AngularVelocity omega_d = sqrt(coupling.k_t/J_red - sigma^2) "Damped frequency";
equation
  connect(left.flange_b, coupling.flange_a);
  connect(coupling.flange_b, right.flange_a);
  twist_exact = -0.01*exp(-sigma*time)*(cos(omega_d*time) + sigma/omega_d*sin(omega_d*time));
  annotation(
    experiment(StartTime=0, StopTime=0.2, Interval=0.0005, Tolerance=1e-8),
    Documentation(info="<html>
<p>The twist swings as one mass J<sub>1</sub>J<sub>2</sub>/(J<sub>1</sub> + J<sub>2</sub>) on the coupling.</p>
<p><b>Source:</b> textbook.</p>
</html>"));
end TwoMassTwist;
