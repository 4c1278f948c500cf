within HydraulicTestBench.Hydraulics;
model Orifice "Turbulent orifice of fixed opening, thesis Eq. 3.6"
  extends Icons.Component;
  extends Interfaces.PartialTwoPort;
  parameter Types.Area K(min=0) "Opening area, discharge coefficient included";
  parameter Types.Density rho "Density of oil";
  parameter Types.Pressure dp_smooth(min=1) = 1e4 "Below this difference the law turns into a straight line";
equation
  q = Functions.orificeFlow(dp, K, rho, dp_smooth);
  annotation(Documentation(info="<html>
<p>Q = sign(&Delta;p) K &radic;(2/&rho; |&Delta;p|), smooth through zero.</p>
<p><b>Source:</b> thesis Eq. 3.6; smoothing and its effect: <code>Functions.orificeFlow</code>.</p>
<p><b>Valid:</b> either direction of flow.</p>
<p><b>Leaves out:</b> cavitation, inertia of the oil.</p>
</html>"));
end Orifice;
