within HydraulicTestBench.Effects;
model ValveSaturation "Stops of the spool (valve.saturation)"
  extends Interfaces.PartialSpool(u(start=0, fixed=true), u_t(start=0, fixed=true));
  parameter Real inverse_u_max(final unit="1", min=0, max=20, nominal=3) = 0
    "One over the largest spool position, 0 = off"
    annotation(__HydraulicTestBench(inverse="u_max", limits="u"));
  constant Types.Duration T_u = 1e-4 "How fast the speed is lost in a stop";
protected
  Types.SpoolPosition u_max "Largest position";
  Types.SpoolAcceleration free "Acceleration without stops";
equation
  u_max = 1/max(inverse_u_max, 1e-9);
  free = omega_v^2*(u_ref - u) - 2*zeta_v*omega_v*u_t;
  u_tt = max((-(u_max + u)/T_u - 2*u_t)/T_u, min(free, ((u_max - u)/T_u - 2*u_t)/T_u));
  der(u) = u_t;
  der(u_t) = u_tt;
  annotation(__HydraulicTestBench(effect="valve.saturation", slot="spool"), Documentation(info="<html>
<p>The spool stops at |u| = u<sub>max</sub> and stays there while it is pushed outwards; its speed is lost in the
stop within some T<sub>u</sub>, without an event, and nothing winds up.</p>
<p><b>Source:</b> this library; thesis Eq. 3.19 between the stops.</p>
<p><b>Valid:</b> a stop that gives back no energy.</p>
<p><b>Leaves out:</b> elasticity of the stop.</p>
</html>"));
end ValveSaturation;
