within HydraulicTestBench.Validation;
model DeadTimeSine "Sine through the Pade dead time"
  extends Icons.Example;
  Pump.PadeDeadTime deadTime(tau=3.83e-3) "Dead time of the free set"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Types.SpoolPosition y_exact = sin(omega*(time - deadTime.tau)) "Closed form";
  Types.SpoolPosition error = deadTime.y - y_exact "Difference from the closed form, transient at the start";
protected
  final parameter Types.AngularVelocity omega = 2*Constants.pi*30 "Angular frequency";
equation
  deadTime.s = sin(omega*time);
  annotation(
    experiment(StartTime=0, StopTime=0.2, Interval=0.0005, Tolerance=1e-9),
    Documentation(info="<html>
<p>At 30 Hz and 3.83 ms the approximation is off by 1e-6; what the start leaves decays within 20 ms.</p>
<p><b>Source:</b> thesis Eq. 3.20, e<sup>-&tau;s</sup>.</p>
</html>"));
end DeadTimeSine;
