within HydraulicTestBench.Types;
type Frequency = Real(
    final quantity="Frequency", final unit="Hz",
    min=0, nominal=1) "Frequency in cycles per second"
  annotation(Documentation(info="<html>
<p>Test frequencies of Eq. 2.1.</p>
<p><b>Source:</b> thesis; the numbers inside a model are SI units.</p>
</html>"));
