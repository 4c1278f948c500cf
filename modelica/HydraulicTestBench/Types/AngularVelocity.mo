within HydraulicTestBench.Types;
type AngularVelocity = Real(
    final quantity="AngularVelocity", final unit="rad/s",
    nominal=1) "Angular velocity"
  annotation(Documentation(info="<html>
<p>Derivative of an angle.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
