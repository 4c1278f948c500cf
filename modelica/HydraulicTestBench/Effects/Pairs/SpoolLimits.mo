within HydraulicTestBench.Effects.Pairs;
model SpoolLimits "Stops and largest speed of the spool at once"
  extends Interfaces.PartialSpool(u(start=0, fixed=true), u_t(start=0, fixed=true));
  parameter Real inverse_u_max(final unit="1", min=0, max=20, nominal=3) = 0
    "One over the largest spool position, 0 = off"
    annotation(__HydraulicTestBench(inverse="u_max", limits="u"));
  parameter Real inverse_r_max(final unit="s", min=0, max=0.2, nominal=0.03) = 0
    "One over the largest spool speed, 0 = off"
    annotation(__HydraulicTestBench(inverse="r_max", limits="u_t"));
protected
  Types.SpoolAcceleration free "Acceleration without limits";
  Boolean is_up(start=false, fixed=true) "Whether the spool is in its upper stop";
  Boolean is_down(start=false, fixed=true) "Whether it is in its lower stop";
  Boolean is_fast "Whether the limit holds the speed";
equation
  is_up = u*inverse_u_max > 1;
  is_down = u*inverse_u_max < -1;
  free = omega_v^2*(u_ref - u) - 2*zeta_v*omega_v*u_t;
  is_fast = u_t*inverse_r_max > 1 and free > 0 or u_t*inverse_r_max < -1 and free < 0;
  u_tt = if is_fast or is_up and free > 0 or is_down and free < 0 then 0 else free;
  der(u) = u_t;
  der(u_t) = u_tt;
  when {is_up, is_down} then
    reinit(u_t, 0);
  end when;
  annotation(__HydraulicTestBench(pair="spool", of={"valve.saturation", "valve.rate_limit"}), Documentation(info="<html>
<p>The laws of <code>ValveSaturation</code> and <code>ValveRateLimit</code> on one spool: the states are the filling's
own, so two fillings cannot share them.</p>
<p><b>Source:</b> this library; thesis Eq. 3.19 between the limits.</p>
<p><b>Valid:</b> as for the two classes.</p>
</html>"));
end SpoolLimits;
