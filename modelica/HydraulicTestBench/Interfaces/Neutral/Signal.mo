within HydraulicTestBench.Interfaces.Neutral;
model Signal "The signal as it is"
  extends PartialSignal;
equation
  y = s;
  annotation(Documentation(info="<html>
<p>The base model's filling of the slot <code>Interfaces.PartialSignal</code>: exactly nothing. A compiler removes
it.</p>
<p><b>Source:</b> thesis Eq. 3.1 to 3.20, which have no such term.</p>
</html>"));
end Signal;
