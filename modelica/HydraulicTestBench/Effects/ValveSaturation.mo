within HydraulicTestBench.Effects;
model ValveSaturation "Stops of the spool (valve.saturation)"
  extends Interfaces.PartialSpool(u(start=0, fixed=true), u_t(start=0, fixed=true));
  parameter Real inverse_u_max(final unit="1", min=0, max=20, nominal=3) = 0
    "One over the largest spool position, 0 = off"
    annotation(__HydraulicTestBench(inverse="u_max", limits="u"));
protected
  Types.SpoolAcceleration free "Acceleration without stops";
  Boolean is_up(start=false, fixed=true) "Whether the spool is in its upper stop";
  Boolean is_down(start=false, fixed=true) "Whether it is in its lower stop";
equation
  is_up = u*inverse_u_max > 1;
  is_down = u*inverse_u_max < -1;
  free = omega_v^2*(u_ref - u) - 2*zeta_v*omega_v*u_t;
  u_tt = if is_up and free > 0 or is_down and free < 0 then 0 else free;
  der(u) = u_t;
  der(u_t) = u_tt;
  when {is_up, is_down} then
    reinit(u_t, 0);
  end when;
  annotation(__HydraulicTestBench(effect="valve.saturation", slot="spool"), Documentation(info="<html>
<p>The spool stops at |u| = u<sub>max</sub> and stays there while it is pushed outwards; its speed is lost in the
stop, and nothing winds up.</p>
<p><b>Source:</b> this library; thesis Eq. 3.19 between the stops.</p>
<p><b>Valid:</b> a stop that gives back no energy.</p>
<p><b>Leaves out:</b> elasticity of the stop.</p>
</html>"));
end ValveSaturation;
