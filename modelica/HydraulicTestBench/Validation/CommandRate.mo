within HydraulicTestBench.Validation;
model CommandRate "Rate of a sine, told and untold"
  extends Icons.Example;
  Pump.CommandRateObserver told "Observer that is told the rate"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Pump.CommandRateObserver untold "Observer that is not"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
  Types.PercentRate rate_exact = omega*cos(omega*time) "Rate of the sine";
  Types.PercentRate error_told = told.rate - rate_exact "Difference where it is told";
  Types.PercentRate error = untold.rate - rate_exact "Difference where it is not, transient at the start";
protected
  constant Types.AngularVelocity omega = 2*Constants.pi*20 "Angular frequency";
equation
  told.s = sin(omega*time);
  told.s_t = rate_exact;
  untold.s = sin(omega*time);
  untold.s_t = 0;
  annotation(
    experiment(StartTime=0, StopTime=0.2, Interval=0.0005, Tolerance=1e-9),
    Documentation(info="<html>
<p>Told, the observer gives the rate exactly; untold, with the share (&omega;T)<sup>3</sup> of error, 2.5e-4 at 20
Hz.</p>
<p><b>Source:</b> <code>Pump.CommandRateObserver</code>.</p>
</html>"));
end CommandRate;
