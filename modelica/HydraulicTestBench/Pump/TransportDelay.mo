within HydraulicTestBench.Pump;
model TransportDelay "Dead time as a true delay"
  extends Interfaces.PartialDeadTime;
  parameter Types.Duration tau_max = 0.05 "Longest dead time, sizes the memory";
equation
  y = delay(s, tau, tau_max);
  annotation(Documentation(info="<html>
<p>y(t) = s(t - tau). Alternative to <code>PadeDeadTime</code>: exact also for jumps, at the price of a memory that not
every solver and importing tool handles well.</p>
<p><b>Source:</b> thesis Eq. 3.20, e<sup>-&tau;s</sup>; Modelica Language Specification 3.6, Section 3.7.4.1. tau_max is
the upper bound of Table 4.6.</p>
<p><b>Valid:</b> 0 &le; tau &le; tau_max. Before the time tau has passed, y is the first value of s (not 0 as with
<code>PadeDeadTime</code>).</p>
</html>"));
end TransportDelay;
