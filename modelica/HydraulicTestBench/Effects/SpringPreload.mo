within HydraulicTestBench.Effects;
model SpringPreload "Preload of the centring springs (spring.preload)"
  extends Interfaces.PartialPistonForce;
  parameter Types.Force F_0(min=0, max=500, nominal=60) = 0 "Preload, 0 = off";
  constant Types.Length x_t = 0.2e-3 "Width of the sign change";
equation
  f = -F_0*tanh(x/x_t);
  annotation(__HydraulicTestBench(effect="spring.preload", slot="pistonForce"), Documentation(info="<html>
<p>f = -F<sub>0</sub> tanh(x/x<sub>t</sub>).</p>
<p><b>Source:</b> joins the force balance, thesis Eq. 3.9.</p>
<p><b>Valid:</b> any position.</p>
<p><b>Leaves out:</b> play between the springs and the piston.</p>
</html>"));
end SpringPreload;
