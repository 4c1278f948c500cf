within HydraulicTestBench.Effects.Smooth;
model CardSampling "Mean of a sampled output of the controller card"
  extends Interfaces.PartialSignal(y(start=0, fixed=true));
  parameter Types.Duration T_s(min=0, max=20e-3, nominal=4e-3) = 0 "Sampling time, 0 = off";
  constant Types.Duration T_min = 1e-6 "Shortest sampling time";
protected
  final parameter Types.Duration T_held = max(T_s, T_min) "Sampling time in force";
  Real moved(start=0, fixed=true, nominal=1) "By what the output moves in a sampling time, at its rate";
equation
  der(y) = moved/T_held;
  der(moved) = (12*(s - y) - 6*moved)/T_held;
  annotation(__HydraulicTestBench(smooth="card.sampling", slot="cardOutput", bypass=true), Documentation(info="<html>
<p>What is held between samples is late by half a sampling time in the mean. The law has the series of
(1 - exp(-s T<sub>s</sub>))/(s T<sub>s</sub>) up to the square of s.</p>
<p><b>Source:</b> Franklin, Powell and Workman, Digital Control of Dynamic Systems, 1998, section 5.3, for what a hold
does; the approximation is this library's.</p>
<p><b>Valid:</b> below a fifth of the sampling frequency; there it errs by 0.3 % at most.</p>
<p><b>Leaves out:</b> the steps themselves.</p>
</html>"));
end CardSampling;
