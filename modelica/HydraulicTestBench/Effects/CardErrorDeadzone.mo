within HydraulicTestBench.Effects;
model CardErrorDeadzone "Dead zone of the outer controller (card.error_deadzone)"
  extends Interfaces.PartialSignalWithRate;
  parameter Types.Angle e_0(min=0, max=20e-3, nominal=5e-4) = 0 "Half of the dead zone, 0 = off";
equation
  y = noEvent(if s > 0 then max(s - e_0, 0) else min(s + e_0, 0));
  y_t = noEvent(if abs(s) >= e_0 then s_t else 0);
  annotation(__HydraulicTestBench(effect="card.error_deadzone", slot="angleError"), Documentation(info="<html>
<p>The outer controller sees sign(e) max(|e| - e<sub>0</sub>, 0), and the rate of that.</p>
<p><b>Source:</b> this library; goes into thesis Eq. 3.18.</p>
<p><b>Valid:</b> any error.</p>
</html>"));
end CardErrorDeadzone;
