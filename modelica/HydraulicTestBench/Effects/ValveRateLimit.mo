within HydraulicTestBench.Effects;
model ValveRateLimit "Largest speed of the spool (valve.rate_limit)"
  extends Interfaces.PartialSpool(u(start=0, fixed=true), u_t(start=0, fixed=true));
  parameter Real inverse_r_max(final unit="s", min=0, max=0.2, nominal=0.03) = 0
    "One over the largest spool speed, 0 = off"
    annotation(__HydraulicTestBench(inverse="r_max", limits="u_t"));
  constant Types.Duration T_r = 1e-4 "How fast the largest speed is taken on";
protected
  Types.SpoolVelocity r_max "Largest speed";
  Types.SpoolAcceleration free "Acceleration without limit";
equation
  r_max = 1/max(inverse_r_max, 1e-9);
  free = omega_v^2*(u_ref - u) - 2*zeta_v*omega_v*u_t;
  u_tt = max(-(r_max + u_t)/T_r, min(free, (r_max - u_t)/T_r));
  der(u) = u_t;
  der(u_t) = u_tt;
  annotation(__HydraulicTestBench(effect="valve.rate_limit", slot="spool"), Documentation(info="<html>
<p>The spool's speed is held at r<sub>max</sub> while it is asked to be faster; nothing winds up. The limit is come to
with the lag T<sub>r</sub> and never passed, so that no event is needed.</p>
<p><b>Source:</b> this library; thesis Eq. 3.19 below the limit.</p>
<p><b>Valid:</b> a pilot stage or a drive that gives a largest flow.</p>
<p><b>Leaves out:</b> dependence of that speed on pressure.</p>
</html>"));
end ValveRateLimit;
