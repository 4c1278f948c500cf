within HydraulicTestBench.Effects;
model LinkageBacklash "Free play between piston and measured angle (linkage.backlash)"
  extends Interfaces.PartialSignalWithRate;
  parameter Types.Length d(min=0, max=1e-3, nominal=1e-4) = 0 "Half of the free play, 0 = off";
  constant Types.Length w = 1e-6 "Way over which the plate comes along";
initial equation
  y = s;
equation
  y_t = max(s_t, 0)*max((s - y - d)/w + 1, 0) + min(s_t, 0)*max((y - s - d)/w + 1, 0);
  der(y) = y_t;
  annotation(__HydraulicTestBench(effect="linkage.backlash", slot="linkage"), Documentation(info="<html>
<p>The plate's end y stays where it is while the piston s moves freely by 2d, and goes with it, at its speed, once
it is met: over the way w its speed rises from nothing to the piston's, so that no event is needed. The feedback sees
the angle behind the play. At the start the piston stands in the middle of it.</p>
<p><b>Source:</b> this library; thesis Eq. 3.10 to 3.12 for what follows from y.</p>
<p><b>Valid:</b> a plate that stays where it is left: friction holds it, its inertia counts with the piston.</p>
<p><b>Leaves out:</b> bounce, elastic contact.</p>
</html>"));
end LinkageBacklash;
