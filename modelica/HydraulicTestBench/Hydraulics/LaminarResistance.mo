within HydraulicTestBench.Hydraulics;
model LaminarResistance "Flow in proportion to pressure difference"
  extends Icons.Component;
  extends Interfaces.PartialTwoPort;
  parameter Real G(final unit="m3/(s.Pa)", min=0, nominal=1e-12) "Flow over pressure difference";
equation
  q = G*dp;
  annotation(Documentation(info="<html>
<p>Q = G &Delta;p: a gap, a leak, a thin bore. A round bore of diameter d and length l has
G = &pi;d<sup>4</sup>/(128 &rho;&nu;l).</p>
<p><b>Source:</b> law of Hagen and Poiseuille.</p>
<p><b>Valid:</b> Reynolds numbers below about 2300.</p>
<p><b>Leaves out:</b> turbulence, inertia of the oil, change of viscosity.</p>
</html>"));
end LaminarResistance;
