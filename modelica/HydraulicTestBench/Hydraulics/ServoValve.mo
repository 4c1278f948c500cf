within HydraulicTestBench.Hydraulics;
model ServoValve "4/3-way servo valve with the dynamics of its spool, thesis Eq. 5.2"
  extends Icons.Component;
  parameter Types.Area K_sv(min=0) = 1.863e-5 "Opening area of an edge at full stroke, discharge coefficient included";
  parameter Types.NaturalFrequency omega_sv = 2*Constants.pi*78.1 "Natural frequency of the spool";
  parameter Types.DampingRatio zeta_sv = 0.646 "Damping ratio of the spool";
  parameter Types.Density rho "Density of oil";
  parameter Types.Pressure dp_smooth(min=1) = 1e4 "Width of the orifice law around zero pressure difference";
  Interfaces.Port_a port_P "Supply"
    annotation(Placement(transformation(extent={{-60, -110}, {-40, -90}})));
  Interfaces.Port_b port_T "Tank"
    annotation(Placement(transformation(extent={{40, -110}, {60, -90}})));
  Interfaces.Port_b port_A "Joined to P by positive commands"
    annotation(Placement(transformation(extent={{-60, 90}, {-40, 110}})));
  Interfaces.Port_b port_B "Joined to T by positive commands"
    annotation(Placement(transformation(extent={{40, 90}, {60, 110}})));
  Interfaces.RealInput u_ref(unit="1") "Command, 1 = full stroke"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealOutput u_sv(unit="1") "Spool position"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  replaceable Pump.SecondOrderSpool spool(omega_v=omega_sv, zeta_v=zeta_sv) constrainedby Interfaces.PartialSpool(
    omega_v=omega_sv, zeta_v=zeta_sv) "Dynamics of the spool"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-72, -12}, {-48, 12}})));
  replaceable Interfaces.Neutral.Signal spoolOpening constrainedby Interfaces.PartialSignal
    "Opening of the edges from the spool position"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-32, -12}, {-8, 12}})));
  ProportionalValve edges(final rho=rho, final k1=0, final k2=0, final k3=K_sv, final dp_smooth=dp_smooth)
    "Four edges whose area is proportional to the opening"
    annotation(Placement(transformation(extent={{8, -12}, {32, 12}})));
equation
  connect(u_ref, spool.u_ref);
  connect(spool.u, spoolOpening.s);
  connect(spoolOpening.y, edges.u);
  connect(port_P, edges.port_P);
  connect(port_T, edges.port_T);
  connect(port_A, edges.port_A);
  connect(port_B, edges.port_B);
  u_sv = spool.u;
  annotation(Documentation(info="<html>
<p>Each open edge has the area u K<sub>sv</sub>. With equal flow through both, p<sub>A</sub> - p<sub>B</sub> =
p<sub>L</sub> and no pressure in the tank, the two orifices in series give Q = u K<sub>sv</sub>
&radic;((p<sub>s</sub> - sign(u) p<sub>L</sub>)/&rho;), which is Eq. 5.2: K<sub>sv</sub> there is the area of one edge.
The slot <code>spoolOpening</code> takes what overlap or an offset make of the spool's position.</p>
<p><b>Source:</b> thesis Eq. 5.2 and 5, Appendix D.6, Table 4 (Parker D3FP).</p>
<p><b>Valid:</b> any pressures; the area stays at its full size beyond |u| = 1.</p>
<p><b>Leaves out:</b> stops and speed limit of the spool, leakage past closed edges, flow forces.</p>
</html>"));
end ServoValve;
