within HydraulicTestBench.Types;
type Angle = Real(
    final quantity="Angle", final unit="rad", displayUnit="deg",
    nominal=0.1) "Angle"
  annotation(Documentation(info="<html>
<p>Radians inside, degrees on display.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
