within HydraulicTestBench.Sources;
block SteppedSine "Command of one frequency response test, with its exact rate"
  extends Icons.Component;
  parameter Types.Percent offset = 25 "Offset O";
  parameter Types.Percent amplitude = 10 "Amplitude A";
  parameter Types.Frequency f = 1 "Frequency";
  parameter Real t_ramp(final unit="s") = 0.5 "When the ramp to the offset begins";
  parameter Real t_hold(final unit="s") = 1 "When the offset is reached";
  parameter Real t_sine(final unit="s") = 2 "When the sine begins";
  Interfaces.RealOutput y(unit="%") "Command"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput y_t(unit="%/s") "Rate of the command"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
protected
  final parameter Types.AngularVelocity omega = 2*Constants.pi*f "Angular frequency";
equation
  if time < t_ramp then
    y = 0;
    y_t = 0;
  elseif time < t_hold then
    y = offset*(time - t_ramp)/(t_hold - t_ramp);
    y_t = offset/(t_hold - t_ramp);
  elseif time < t_sine then
    y = offset;
    y_t = 0;
  else
    y = offset + amplitude*sin(omega*(time - t_sine));
    y_t = amplitude*omega*cos(omega*(time - t_sine));
  end if;
  annotation(Documentation(info="<html>
<p>Zero for half a second, a ramp to the offset, a second to settle, then A sin(2&pi;f(t - t<sub>sine</sub>)) + O.</p>
<p><b>Source:</b> thesis Section 2.1.1, Eq. 2.1 and Fig. 2.1.</p>
<p><b>Valid:</b> t_ramp &lt; t_hold &le; t_sine.</p>
<p><b>Leaves out:</b> the ramp back to zero after the test.</p>
</html>"));
end SteppedSine;
