within HydraulicTestBench.Sources;
block GrowingSines "Three sines that grow from zero, with their exact rate"
  extends Icons.Component;
  parameter Types.Percent A[3] = {40, 15, 5} "Amplitudes";
  parameter Types.Frequency f[3] = {0.4, 2.3, 7.1} "Frequencies";
  parameter Types.Duration T = 0.5 "Time constant of the growth";
  Interfaces.RealOutput y(unit="%") "Command"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput y_t(unit="%/s") "Rate of the command"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
protected
  constant Real pi2(final unit="1") = 2*Constants.pi "Full turn";
  Types.Percent sines "Sum of the sines";
  Types.PercentRate sines_t "Its rate";
equation
  sines = A[1]*sin(pi2*f[1]*time) + A[2]*sin(pi2*f[2]*time) + A[3]*sin(pi2*f[3]*time);
  sines_t = pi2*(A[1]*f[1]*cos(pi2*f[1]*time) + A[2]*f[2]*cos(pi2*f[2]*time) + A[3]*f[3]*cos(pi2*f[3]*time));
  y = (1 - exp(-time/T))*sines;
  y_t = exp(-time/T)/T*sines + (1 - exp(-time/T))*sines_t;
  annotation(Documentation(info="<html>
<p>y = (1 - e<sup>-t/T</sup>) &Sigma; A<sub>i</sub> sin(2&pi;f<sub>i</sub>t): starts at zero with rate zero, and excites
slow and fast motion at once.</p>
<p><b>Source:</b> this library; a smooth stand-in for the stochastic test of thesis Section 2.1.3.</p>
<p><b>Valid:</b> a start at time 0.</p>
</html>"));
end GrowingSines;
