within HydraulicTestBench.Validation;
model PulseSpeed "Pulse sensor on a shaft that speeds up evenly"
  extends Icons.Example;
  Mechanics.Inertia inertia(J=0.1) "Shaft"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Mechanics.TorqueSource torque "Constant torque"
    annotation(Placement(transformation(extent={{-80, -40}, {-40, 0}})));
  Mechanics.PulseSensor sensor "Ten pulses per revolution"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
  Integer k "Revolutions so far, in tenths";
  Types.AngularVelocity w_exact "Mean speed between the last two rising edges, closed form";
  Types.AngularVelocity error = sensor.w - w_exact "Difference from the closed form";
protected
  constant Types.AngularAcceleration a = 4 "Acceleration";
  constant Types.Angle pitch = 2*Constants.pi/10 "Angle between two edges";
equation
  connect(inertia.flange_b, sensor.flange);
  connect(torque.flange, inertia.flange_a);
  torque.tau = 0.1*a;
  sensor.direction = 1;
  k = integer(0.5*a*time^2/pitch);
  w_exact = noEvent(if k < 1 then 0
    else pitch/(sqrt(2*pitch*k/a) - sqrt(2*pitch*(k - 1)/a)));
  annotation(
    experiment(StartTime=0, StopTime=3, Interval=0.01, Tolerance=1e-9),
    Documentation(info="<html>
<p>From rest at acceleration a, edge k comes at &radic;(2k 2&pi;/(10a)), the first one at the start; the
sensor shows the mean speed between the last two.</p>
<p><b>Source:</b> thesis Eq. 5.1; uniform acceleration.</p>
</html>"));
end PulseSpeed;
