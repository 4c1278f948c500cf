within HydraulicTestBench.Effects;
model CouplingCompliance "Coupling between the motors that twists (coupling.compliance)"
  extends Interfaces.PartialCoupling;
  parameter Real inverse_k_t(final unit="rad/(N.m)", min=0, max=1e-2, nominal=3e-4) = 0
    "One over the torsional stiffness, 0 = off"
    annotation(__HydraulicTestBench(inverse="k_t"));
  parameter Types.Duration T_d(min=0, max=1e-2, nominal=2e-4) = 2e-4 "Damping over stiffness";
  constant Real stiffest(final unit="rad/(N.m)") = 1e-7 "Least twist over torque";
initial equation
  phi_rel = 0;
  der(flange_b.phi) = der(flange_a.phi);
equation
  tau = (phi_rel + T_d*(der(flange_b.phi) - der(flange_a.phi)))/max(inverse_k_t, stiffest);
  annotation(__HydraulicTestBench(effect="coupling.compliance", slot="coupling", bypass=true),
    Documentation(info="<html>
<p>&tau; = k<sub>t</sub> (&phi;<sub>rel</sub> + T<sub>d</sub> &omega;<sub>rel</sub>). A rigid coupling has no such
equation: at 1/k<sub>t</sub> = 0 a stiffness of 10<sup>7</sup> N m/rad is left, and <b>off</b> means the neutral
filling.</p>
<p><b>Source:</b> this library; thesis Fig. 5.1 and 5.12, where the coupling is rigid.</p>
<p><b>Valid:</b> small twists. It starts without twist; the shaft behind it takes its start from the one before, as
behind a rigid one, and has none of its own (<code>phi(fixed=false), w(fixed=false)</code>).</p>
<p><b>Leaves out:</b> play, inertia of the coupling.</p>
</html>"));
end CouplingCompliance;
