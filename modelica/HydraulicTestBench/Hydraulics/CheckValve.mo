within HydraulicTestBench.Hydraulics;
model CheckValve "Valve that lets oil pass one way"
  extends Icons.Component;
  extends Interfaces.PartialTwoPort;
  parameter Types.Area K(min=0) "Opening area when fully open, discharge coefficient included";
  parameter Types.Density rho "Density of oil";
  parameter Types.Pressure p_crack(min=0) = 0.5e5 "Difference at which it begins to open";
  parameter Types.Pressure dp_open(min=1) = 0.5e5 "Further difference until it is fully open";
  parameter Types.Pressure dp_smooth(min=1) = 1e4 "Width of the orifice law around zero pressure difference";
  Real opening(unit="1") "Share of the full opening";
protected
  Real lift(unit="1") "Difference over the range of opening, 0 ... 1";
equation
  lift = min(max((dp - p_crack)/dp_open, 0), 1);
  opening = lift*lift*(3 - 2*lift);
  q = Functions.orificeFlow(dp, opening*K, rho, dp_smooth);
  annotation(Documentation(info="<html>
<p>Closed up to p<sub>crack</sub>, then opening along a smooth curve to the full area, where the law is that of
<code>Orifice</code>. Flow from b to a is exactly zero.</p>
<p><b>Source:</b> thesis Eq. 3.6 for the flow; the opening is this library's.</p>
<p><b>Valid:</b> either direction of the pressure difference, p<sub>crack</sub> of 0 or more.</p>
<p><b>Leaves out:</b> mass and chatter of the ball, leakage when closed.</p>
</html>"));
end CheckValve;
