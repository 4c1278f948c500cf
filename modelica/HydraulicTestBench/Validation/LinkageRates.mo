within HydraulicTestBench.Validation;
model LinkageRates "Rates of the swash plate against its angle"
  extends Icons.Example;
  Pump.SwashPlateLinkage swashPlate(a=0.0877) "Linkage"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Types.Angle alpha_integrated(start=0, fixed=true) "Integral of the angular velocity";
  Types.AngularVelocity rate_integrated(start=10e-3*omega/0.0877, fixed=true) "Integral of the angular acceleration";
  Types.Angle error = swashPlate.alpha - alpha_integrated "Angle against integrated velocity";
  Types.AngularVelocity error_t = swashPlate.alpha_t - rate_integrated "Velocity against integrated acceleration";
protected
  constant Types.AngularVelocity omega = 2*Constants.pi*5 "Angular frequency";
equation
  swashPlate.x = 10e-3*sin(omega*time);
  swashPlate.x_t = 10e-3*omega*cos(omega*time);
  swashPlate.x_tt = -10e-3*omega^2*sin(omega*time);
  der(alpha_integrated) = swashPlate.alpha_t;
  der(rate_integrated) = swashPlate.alpha_tt;
  annotation(
    experiment(StartTime=0, StopTime=1, Interval=0.005, Tolerance=1e-9),
    Documentation(info="<html>
<p>Velocity and acceleration of the angle integrate to angle and velocity.</p>
<p><b>Source:</b> thesis Eq. 3.10, 3.11, 3.12.</p>
</html>"));
end LinkageRates;
