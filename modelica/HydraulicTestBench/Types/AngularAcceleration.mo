within HydraulicTestBench.Types;
type AngularAcceleration = Real(
    final quantity="AngularAcceleration", final unit="rad/s2",
    nominal=100) "Angular acceleration"
  annotation(Documentation(info="<html>
<p>Second derivative of an angle.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
