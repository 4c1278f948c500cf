within HydraulicTestBench.Types;
type Acceleration = Real(
    final quantity="Acceleration", final unit="m/s2",
    nominal=10) "Acceleration"
  annotation(Documentation(info="<html>
<p>Positive in the direction of the position.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
