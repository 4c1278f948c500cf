within HydraulicTestBench.Effects;
model SpringHardening "Centring spring that stiffens with its stroke (spring.hardening)"
  extends Interfaces.PartialPistonForce;
  parameter Real k_3(final unit="N/m3", min=0, max=2e8, nominal=2.5e7) = 0 "Cubic stiffness, 0 = off";
equation
  f = -k_3*x^3;
  annotation(__HydraulicTestBench(effect="spring.hardening", slot="pistonForce"), Documentation(info="<html>
<p>f = -k<sub>3</sub> x<sup>3</sup>.</p>
<p><b>Source:</b> joins the force balance, thesis Eq. 3.9.</p>
<p><b>Valid:</b> the whole stroke.</p>
<p><b>Leaves out:</b> asymmetry of the spring.</p>
</html>"));
end SpringHardening;
