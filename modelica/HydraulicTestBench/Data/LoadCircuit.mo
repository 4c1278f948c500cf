within HydraulicTestBench.Data;
record LoadCircuit "Parameters of the load circuit test bench, thesis Chapters 5 and 6"
  extends Icons.Record;
  Types.Volume V_L0 = 1.01e-3 "Dead volume on each side of the load motor";
  Types.Volume V_s0 = 1.52e-3 "Dead volume on each side of the supply motor";
  Types.Volume Vm_max = 60e-6 "Displacement per revolution of a motor at its largest angle";
  Types.Angle alpha_m = 35*Constants.pi/180 "Largest angle of a motor, at which both stand";
  Types.MomentOfInertia Jeff = 0.0733 "Inertia of both motors and the shaft";
  Real c(unit="N.m.s/rad") = 0.26 "Linear friction coefficient";
  Types.Area K_sv = 1.863e-5 "Opening area of the servo valve";
  Types.NaturalFrequency omega_sv = 2*Constants.pi*78.1 "Natural frequency of the servo valve";
  Types.DampingRatio zeta_sv = 0.646 "Damping ratio of the servo valve";
  Types.Pressure p_sL = 310e5 "Supply pressure of the load circuit";
  Types.Pressure p_refill = 25e5 "Refill pressure of the supply circuit";
  Real K_qu(unit="m3/s") = 0.0035 "Flow gain of the servo valve about its working point";
  Real r(unit="s/rad") = 13.8806 "Friction: steepness at standstill";
  Types.AngularVelocity w0 = 8.3593 "Friction: speed over which stiction fades";
  Types.Torque Tc = 14.8939 "Friction: Coulomb friction";
  Types.Torque Ts = 54.8258 "Friction: stiction";
  Real K_Ps(unit="s") = 1.06e-7 "Gain of the speed controller, rad per rad/s";
  Types.Duration T_is = 0.000159 "Integration time of the speed controller";
  Real K_PL(unit="1/Pa") = 1.98e-9 "Gain of the load controller";
  Types.Duration T_iL = 0.03 "Integration time of the load controller";
  annotation(Documentation(info="<html>
<p>Controller gains are the manually tuned ones. The thesis does not print the supply pressure of the load circuit. Its
gains imply it: K<sub>qu</sub> = K<sub>sv</sub> &radic;(p<sub>s</sub>/&rho;) gives 309 bar from 0.0035 (300 to 318 with
its rounding), K<sub>qp</sub> = 0.1 K<sub>sv</sub>/(2&radic;(&rho;p<sub>s</sub>)) gives 315 bar from 5.61e-12. 310 bar
is taken.</p>
<p><b>Source:</b> thesis Table 5.1 (volumes, inertia, c, K_qu), Tables 3 and 4 (motor, valve), 6.1 and 6.2 (controllers,
friction), Section 3.1.2 (refill).</p>
<p><b>Leaves out:</b> the units that Table 5.1 does not print.</p>
</html>"));
end LoadCircuit;
