within HydraulicTestBench.Validation;
model WinchEnergy "Energy balance of the closed circuit in the crane's winch"
  extends Examples.ActiveHeave;
  Real given(final unit="J", start=0, fixed=true, nominal=1e4) "Put in by pump and refill";
  Real taken(final unit="J", start=0, fixed=true, nominal=1e4) "Taken by the motor and lost in check valves";
  Real passed(final unit="J", start=0, fixed=true, nominal=1e4) "Work that the motor passed on, either way";
  Real stored(final unit="J") "In the oil, beyond the start";
  Real error(unit="1") = (given - taken - stored)/max(passed, 1) "Over the work passed on";
protected
  parameter Types.Pressure p_A = active.volume_A.p_start "Pressure of line A at the start";
  parameter Types.Pressure p_B = active.volume_B.p_start "Pressure of line B at the start";
equation
  der(given) = active.pumpFlow.tau*active.pumpFlow.omega - active.refill.p*active.refill.port.q;
  der(taken) = active.motor.tau*active.omega + active.refill_A.dp*active.refill_A.q
    + active.refill_B.dp*active.refill_B.q;
  der(passed) = abs(active.motor.tau*active.omega);
  stored = active.V_s0/(2*active.volume_A.beta)*(active.volume_A.p^2 + active.volume_B.p^2 - p_A^2 - p_B^2);
  annotation(
    experiment(StartTime=0, StopTime=60, Interval=0.01, Tolerance=1e-7),
    Documentation(info="<html>
<p>What pump and refill put in is taken by the motor and the check valves, or stored in the oil, to 0.1 percent of the
work the motor passes on, over the minute of <code>Examples.ActiveHeave</code>.</p>
<p><b>Source:</b> first law of thermodynamics.</p>
</html>"));
end WinchEnergy;
