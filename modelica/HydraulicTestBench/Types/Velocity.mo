within HydraulicTestBench.Types;
type Velocity = Real(
    final quantity="Velocity", final unit="m/s",
    nominal=0.1) "Velocity"
  annotation(Documentation(info="<html>
<p>Positive in the direction of the position.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
