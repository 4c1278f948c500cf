within HydraulicTestBench.Hydraulics;
model Hose "Hose or pipe in segments, each with friction, inertia and compliance"
  extends Icons.Component;
  parameter Types.Length l(min=1e-3) "Length";
  parameter Types.Length d(min=1e-4) "Inner diameter";
  parameter Integer n(min=1) = 12 "Segments";
  parameter Types.BulkModulus beta "Oil stiffness";
  parameter Types.BulkModulus beta_w = 350e6 "Stiffness of the wall: pressure over relative growth of the volume";
  parameter Types.Duration T_w = 1e-4 "Damping of the wall: pressure of a change lags by this time behind its volume";
  parameter Types.Density rho "Density of oil";
  parameter Types.KinematicViscosity nu(min=1e-9) = 46e-6 "Kinematic viscosity";
  parameter Real roughness(final unit="1", min=0) = 1e-4 "Height of the wall's roughness over the diameter";
  parameter Types.Pressure p_start = 0 "Pressure at the start";
  parameter Types.VolumeFlowRate q_start = 0 "Flow at the start";
  final parameter Types.Area A_l = Constants.pi/4*d*d "Cross section";
  final parameter Types.Volume V_l = A_l*l "Volume";
  Interfaces.Port_a port_a "Inlet at positive flow"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.Port_b port_b "Outlet at positive flow"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  replaceable Fluids.ConstantStiffness fluid[n + 1](each beta=beta) constrainedby Interfaces.PartialFluid(
    each beta=beta) "Stiffness of the oil over pressure, at each node"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-10, -60}, {10, -40}})));
  Types.Pressure p[n + 1](each start=p_start, each fixed=true) "Elastic pressure at the nodes, one at each end";
  Types.VolumeFlowRate q[n](each start=q_start, each fixed=true) "Flow from each node to the next";
  Types.VolumeFlowRate gain[n + 1] "Flow that stays at each node";
  Types.Pressure p_n[n + 1] "Pressure at the nodes";
  Real stiffness[n + 1](each unit="Pa/m3", each nominal=1e13) "Rise of pressure over volume at each node";
equation
  for i in 1:n + 1 loop
    fluid[i].p = p[i];
    stiffness[i] = (if i == 1 or i == n + 1 then 2 else 1)*n/V_l*fluid[i].beta_eff*beta_w/(fluid[i].beta_eff + beta_w);
    der(p[i]) = stiffness[i]*gain[i];
    p_n[i] = p[i] + T_w*stiffness[i]*gain[i];
  end for;
  gain[1] = port_a.q - q[1];
  for i in 2:n loop
    gain[i] = q[i - 1] - q[i];
  end for;
  gain[n + 1] = q[n] + port_b.q;
  for i in 1:n loop
    rho/A_l*l/n*der(q[i]) = p_n[i] - p_n[i + 1] - l/n*Functions.pipeFriction(q[i], d, rho, nu, roughness);
  end for;
  port_a.p = p_n[1];
  port_b.p = p_n[n + 1];
  annotation(Documentation(info="<html>
<p>n columns of oil with inertia &rho;l/(nA) and friction between n + 1 nodes with the compliance of oil and wall, half
as much at either end. Oil and wall give way together, 1/&beta;<sub>h</sub> = 1/&beta; + 1/&beta;<sub>w</sub>, and the
speed of sound is &radic;(&beta;<sub>h</sub>/&rho;): 565 m/s with the default wall, 1265 m/s with a rigid one (say
&beta;<sub>w</sub> = 1e15). The wall of a hose takes energy out of fast waves: p = p<sub>el</sub> + T<sub>w</sub>
dp<sub>el</sub>/dt, a loss factor of &omega;T<sub>w</sub>: 0.27 at 435 Hz with the default. 0 is off.</p>
<p>Both ends are volumes. Connect them to what gives a flow from a pressure: pump, motor, valve, orifice, closed
end. Another hose, a <code>Volume</code>, a <code>Chamber</code> or a <code>Tank</code> at an end needs T<sub>w</sub>
above 0, which gives that end a flow; at 0 that flow is 0/0 and the run ends at its start.</p>
<p><b>Source:</b> thesis Section 4.5 has a hose without its equations. Line in segments and stiffness of hose walls
(70 to
350 MPa): H. E. Merritt, Hydraulic Control Systems, Chapters 2 and 3; friction:
<code>Functions.pipeFriction</code>.</p>
<p><b>Valid:</b> waves much longer than a segment. Mode k of a closed line comes at (2n/&pi;k) sin(&pi;k/2n) of its true
frequency: 12 segments miss the first by 0.3 percent and the fourth by 4.5.</p>
<p><b>Leaves out:</b> friction that depends on frequency (Zielke), creep of the wall, waves faster than the segments
resolve.</p>
</html>"));
end Hose;
