within HydraulicTestBench.Interfaces.Neutral;
model SignalWithRate "The signal and its rate as they are"
  extends PartialSignalWithRate;
equation
  y = s;
  y_t = s_t;
  annotation(Documentation(info="<html>
<p>The base model's filling of the slot <code>Interfaces.PartialSignalWithRate</code>: exactly nothing. A compiler
removes it.</p>
<p><b>Source:</b> thesis Eq. 3.1 to 3.20, which have no such term.</p>
</html>"));
end SignalWithRate;
