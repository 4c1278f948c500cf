within HydraulicTestBench.Pump;
model CommandRateInput "Rate of the command as it is fed"
  extends Interfaces.PartialCommandRate;
equation
  rate = s_t;
  annotation(Documentation(info="<html>
<p>Alternative to <code>CommandRateObserver</code> without states: the rate is what is fed to s_t, and 0 if nobody feeds
it, which would take the command's derivative out of the PD controller.</p>
<p><b>Source:</b> thesis Eq. 3.17.</p>
<p><b>Valid:</b> only where the rate is fed exactly.</p>
</html>"));
end CommandRateInput;
