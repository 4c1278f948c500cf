within HydraulicTestBench.Effects;
model FrictionCoulomb "Dry friction at the control piston (friction.coulomb)"
  extends Interfaces.PartialPistonForce;
  parameter Types.Force F_c(min=0, max=600, nominal=80) = 0 "Friction force, 0 = off";
  constant Types.Velocity v_t = 1e-3 "Width of the sign change";
equation
  f = -F_c*tanh(v/v_t);
  annotation(__HydraulicTestBench(effect="friction.coulomb", slot="pistonForce"), Documentation(info="<html>
<p>f = -F<sub>c</sub> tanh(v/v<sub>t</sub>).</p>
<p><b>Source:</b> joins the force balance, thesis Eq. 3.9.</p>
<p><b>Valid:</b> speeds well above v<sub>t</sub>; below it the piston creeps instead of standing still.</p>
<p><b>Leaves out:</b> sticking.</p>
</html>"));
end FrictionCoulomb;
