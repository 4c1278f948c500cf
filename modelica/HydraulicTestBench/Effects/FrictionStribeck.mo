within HydraulicTestBench.Effects;
model FrictionStribeck "Dry friction that falls with speed (friction.stribeck)"
  extends Interfaces.PartialPistonForce;
  parameter Types.Force F_c(min=0, max=600, nominal=80) = 0 "Friction force at high speed, 0 = off";
  parameter Types.Force F_s(min=0, max=800, nominal=120) = 0 "Friction force near standstill, at least F_c, 0 = off";
  parameter Types.Velocity v_s(min=1e-3, max=50e-3, nominal=5e-3) = 5e-3 "Speed over which it falls";
  constant Types.Velocity v_t = 1e-3 "Width of the sign change";
equation
  f = -tanh(v/v_t)*(F_c + max(F_s - F_c, 0)*exp(-abs(v)/v_s));
  annotation(__HydraulicTestBench(effect="friction.stribeck", slot="pistonForce"), Documentation(info="<html>
<p>f = -tanh(v/v<sub>t</sub>) (F<sub>c</sub> + (F<sub>s</sub> - F<sub>c</sub>) e<sup>-|v|/v<sub>s</sub></sup>). With
F<sub>s</sub> = F<sub>c</sub>, or below it, it is <code>FrictionCoulomb</code>.</p>
<p><b>Source:</b> joins the force balance, thesis Eq. 3.9; the law is that of Eq. 5.38.</p>
<p><b>Valid:</b> v<sub>s</sub> above v<sub>t</sub>.</p>
<p><b>Leaves out:</b> sticking, lag of friction behind speed.</p>
</html>"));
end FrictionStribeck;
