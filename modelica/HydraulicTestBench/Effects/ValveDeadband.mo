within HydraulicTestBench.Effects;
model ValveDeadband "Overlap of the valve's edges (valve.deadband)"
  extends Interfaces.PartialSignal;
  parameter Types.SpoolPosition u_0(min=0, max=0.2, nominal=0.016) = 0 "Overlap, 0 = off";
equation
  y = noEvent(if s > 0 then max(s - u_0, 0) else min(s + u_0, 0));
  annotation(__HydraulicTestBench(effect="valve.deadband", slot="spoolOpening"), Documentation(info="<html>
<p>The opening is sign(u) max(|u| - u<sub>0</sub>, 0). The spool sensor sees u.</p>
<p><b>Source:</b> this library; goes into thesis Eq. 3.3.</p>
<p><b>Valid:</b> any u.</p>
<p><b>Leaves out:</b> leakage of the closed edges.</p>
</html>"));
end ValveDeadband;
