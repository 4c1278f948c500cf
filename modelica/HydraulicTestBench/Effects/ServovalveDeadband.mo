within HydraulicTestBench.Effects;
model ServovalveDeadband "Overlap of the servo valve's edges (servovalve.deadband)"
  extends Interfaces.PartialSignal;
  parameter Types.SpoolPosition u_0(min=0, max=0.2, nominal=0.016) = 0 "Overlap, 0 = off";
equation
  y = noEvent(if s > 0 then max(s - u_0, 0) else min(s + u_0, 0));
  annotation(__HydraulicTestBench(effect="servovalve.deadband", slot="servoOpening"), Documentation(info="<html>
<p>The law of <code>ValveDeadband</code>, on the servo valve of the load circuit.</p>
<p><b>Source:</b> this library; goes into thesis Eq. 5.2.</p>
<p><b>Valid:</b> any spool position.</p>
<p><b>Leaves out:</b> leakage of the closed edges.</p>
</html>"));
end ServovalveDeadband;
