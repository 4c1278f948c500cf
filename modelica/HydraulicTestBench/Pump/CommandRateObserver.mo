within HydraulicTestBench.Pump;
model CommandRateObserver "Rate of the command: what is known of it, plus an estimate of the rest"
  extends Interfaces.PartialCommandRate;
  parameter Types.Duration T_rate(min=1e-5) = 0.5e-3 "Time constant of the estimate";
  Types.Percent followed(stateSelect=StateSelect.always) "Command as the observer follows it";
  Types.Percent untold(start=0, fixed=true, stateSelect=StateSelect.always) "Rate nobody told, times T_rate";
  Types.Percent untold_t(start=0, fixed=true, stateSelect=StateSelect.always)
    "Lasting part of the derivative of untold, times T_rate";
  Types.Percent error "What the observer has not followed yet";
initial equation
  followed = s;
equation
  error = s - followed;
  rate = s_t + (untold + 3*error)/T_rate;
  der(followed) = rate;
  der(untold) = (untold_t + 3*error)/T_rate;
  der(untold_t) = error/T_rate;
  annotation(Documentation(info="<html>
<p>An observer of third order follows the command and gives the rate at which it does so. Where the true rate is fed to
s_t, it follows exactly, and the output <i>is</i> that rate. Where s_t stays 0, the output is the command passed through
s (1 + 3Ts + 3(Ts)<sup>2</sup>)/(1 + Ts)<sup>3</sup>, a differentiator whose relative error is (&omega;T)<sup>3</sup>:
0.03 percent of the rate at 20 Hz and 0.08 percent at 30 Hz with T = 0.5 ms. On the pump's response that is at most
0.004 dB
and 0.03 degrees up to 30 Hz. One law thus does for both, without a switch and without der() of an input.</p>
<p>All states are in percent of command, so that a solver's error control treats them alike.</p>
<p><b>Source:</b> this library, for the derivative in thesis Eq. 3.17.</p>
<p><b>Valid:</b> commands that are smooth on the scale of T. A step gives a pulse of area 1 and of a few T length, as a
card's differentiator does. The poles at -1/T are hardly faster than those of the dead
time, so that they cost an explicit solver little.</p>
<p><b>Leaves out:</b> noise on the command, which any differentiator amplifies (here by 3/T at most).</p>
</html>"));
end CommandRateObserver;
