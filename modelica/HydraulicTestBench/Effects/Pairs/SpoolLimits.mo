within HydraulicTestBench.Effects.Pairs;
model SpoolLimits "Stops and largest speed of the spool at once"
  extends Interfaces.PartialSpool(u(start=0, fixed=true), u_t(start=0, fixed=true));
  parameter Real inverse_u_max(final unit="1", min=0, max=20, nominal=3) = 0
    "One over the largest spool position, 0 = off"
    annotation(__HydraulicTestBench(inverse="u_max", limits="u"));
  parameter Real inverse_r_max(final unit="s", min=0, max=0.2, nominal=0.03) = 0
    "One over the largest spool speed, 0 = off"
    annotation(__HydraulicTestBench(inverse="r_max", limits="u_t"));
  constant Types.Duration T_r = 1e-4 "How fast the largest speed is taken on";
  constant Types.Duration T_u = 1e-4 "How fast the speed is lost in a stop";
protected
  Types.SpoolPosition u_max "Largest position";
  Types.SpoolVelocity r_max "Largest speed";
  Types.SpoolAcceleration free "Acceleration without limits";
  Types.SpoolAcceleration most "Largest acceleration";
  Types.SpoolAcceleration least "Lowest acceleration";
equation
  u_max = 1/max(inverse_u_max, 1e-9);
  r_max = 1/max(inverse_r_max, 1e-9);
  free = omega_v^2*(u_ref - u) - 2*zeta_v*omega_v*u_t;
  most = min((r_max - u_t)/T_r, ((u_max - u)/T_u - 2*u_t)/T_u);
  least = max(-(r_max + u_t)/T_r, (-(u_max + u)/T_u - 2*u_t)/T_u);
  u_tt = max(least, min(free, most));
  der(u) = u_t;
  der(u_t) = u_tt;
  annotation(__HydraulicTestBench(pair="spool", of={"valve.saturation", "valve.rate_limit"}), Documentation(info="<html>
<p>The laws of <code>ValveSaturation</code> and <code>ValveRateLimit</code> on one spool: the states are the filling's
own, so two fillings cannot share them.</p>
<p><b>Source:</b> this library; thesis Eq. 3.19 between the limits.</p>
<p><b>Valid:</b> as for the two classes.</p>
</html>"));
end SpoolLimits;
