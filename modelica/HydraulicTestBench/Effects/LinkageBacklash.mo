within HydraulicTestBench.Effects;
model LinkageBacklash "Free play between piston and measured angle (linkage.backlash)"
  extends Interfaces.PartialSignalWithRate;
  parameter Types.Length d(min=0, max=1e-3, nominal=1e-4) = 0 "Half of the free play, 0 = off";
protected
  Boolean is_ahead(start=false, fixed=true) "Whether the piston moves the plate towards positive x";
  Boolean is_behind(start=false, fixed=true) "Whether it moves it towards negative x";
initial equation
  y = s;
equation
  is_ahead = s_t > 0 and (pre(is_ahead) or s - y >= d);
  is_behind = s_t < 0 and (pre(is_behind) or s - y <= -d);
  y_t = if is_ahead or is_behind then s_t else 0;
  der(y) = y_t;
  annotation(__HydraulicTestBench(effect="linkage.backlash", slot="linkage"), Documentation(info="<html>
<p>The plate's end y stays where it is while the piston s moves freely by 2d, and goes with it, at its speed, once
it is met. The feedback sees the angle behind the play. At the start the piston stands in the middle of it.</p>
<p><b>Source:</b> this library; thesis Eq. 3.10 to 3.12 for what follows from y.</p>
<p><b>Valid:</b> a plate that stays where it is left: friction holds it, its inertia counts with the piston.</p>
<p><b>Leaves out:</b> bounce, elastic contact.</p>
</html>"));
end LinkageBacklash;
