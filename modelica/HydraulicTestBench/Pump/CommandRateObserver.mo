within HydraulicTestBench.Pump;
block CommandRateObserver "Rate of the command: what is known of it, plus an estimate of the rest"
  extends Interfaces.PartialCommandRate;
  parameter Types.Duration T_rate(min=1e-5) = 0.5e-3 "Time constant of the estimate";
  Types.Percent followed(stateSelect=StateSelect.always) "Command as the observer follows it";
  Types.PercentRate untold(start=0, fixed=true, stateSelect=StateSelect.always) "Share of the rate nobody told";
initial equation
  followed = s;
equation
  rate = s_t + untold + 2/T_rate*(s - followed);
  der(followed) = rate;
  der(untold) = (s - followed)/T_rate^2;
  annotation(Documentation(info="<html>
<p>An observer of second order follows the command and gives the rate at which it does so. Where the true rate is fed to
s_t, it follows exactly, and the output <i>is</i> that rate. Where s_t stays 0, the output is
s (1 + 2Ts)/(1 + Ts)<sup>2</sup> of the command, a differentiator whose error is (&omega;T)<sup>2</sup>: 0.4 percent of
the rate at 20 Hz with T = 0.5 ms, which is below 0.01 dB and 0.1 degrees of the pump's response. One parameter thus does
for both, and neither a switch nor der() of an input is needed.</p>
<p><b>Source:</b> this library, for the derivative in thesis Eq. 3.17.</p>
<p><b>Valid:</b> commands that are smooth on the scale of T. A step gives a pulse of area 1 and of a few T length.</p>
<p><b>Leaves out:</b> noise on the command, which any differentiator amplifies.</p>
</html>"));
end CommandRateObserver;
