within HydraulicTestBench.Hydraulics;
model ProportionalValve "Edges of the 4/3-way proportional valve, thesis Eq. 3.1 to 3.3"
  extends Icons.Component;
  parameter Types.Density rho "Density of oil";
  parameter Types.Area k1 "Cubic coefficient of the opening";
  parameter Types.Area k2 "Quadratic coefficient of the opening";
  parameter Types.Area k3 "Linear coefficient of the opening";
  parameter Types.Pressure dp_smooth(min=1) = 1e4 "Below this difference the law turns into a straight line";
  Interfaces.Port_a port_P "Supply"
    annotation(Placement(transformation(extent={{-60, -110}, {-40, -90}})));
  Interfaces.Port_b port_T "Tank"
    annotation(Placement(transformation(extent={{40, -110}, {60, -90}})));
  Interfaces.Port_b port_A "To chamber 1"
    annotation(Placement(transformation(extent={{-60, 90}, {-40, 110}})));
  Interfaces.Port_a port_B "From chamber 2"
    annotation(Placement(transformation(extent={{40, 90}, {60, 110}})));
  Interfaces.RealInput u(unit="1") "Spool opening; positive joins P to A and B to T"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Types.Area K "Opening area of each open edge";
  Types.Pressure dp1 "Pressure difference at the edge of port A";
  Types.Pressure dp2 "Pressure difference at the edge of port B";
  Types.VolumeFlowRate Q1 "Flow into chamber 1";
  Types.VolumeFlowRate Q2 "Flow out of chamber 2";
equation
  K = Functions.valveOpeningArea(u, k1, k2, k3);
  // The flows are continuous where the edges change, because K = 0 there: no event is needed.
  dp1 = noEvent(if u >= 0 then port_P.p else port_T.p) - port_A.p;
  dp2 = port_B.p - noEvent(if u >= 0 then port_T.p else port_P.p);
  Q1 = Functions.orificeFlow(dp1, K, rho, dp_smooth);
  Q2 = Functions.orificeFlow(dp2, K, rho, dp_smooth);
  port_A.q = -Q1;
  port_B.q = Q2;
  port_P.q = noEvent(if u >= 0 then Q1 else -Q2);
  port_P.q + port_T.q + port_A.q + port_B.q = 0;
  annotation(Documentation(info="<html>
<p>Four edges, two of them open at a time: for u &ge; 0 from P to A and from B to T, for u &lt; 0 from P to B and from A
to T.</p>
<p><b>Source:</b> thesis Eq. 3.1, 3.2 (flows), 3.3 (opening).</p>
<p><b>Valid:</b> any spool opening (fully open beyond |u| = 1) and any pressures.</p>
<p><b>Leaves out:</b> overlap, leakage past the closed edges, flow forces; the dynamics of the spool is
<code>Pump.SecondOrderSpool</code>.</p>
</html>"));
end ProportionalValve;
