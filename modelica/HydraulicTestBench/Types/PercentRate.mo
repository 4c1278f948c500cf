within HydraulicTestBench.Types;
type PercentRate = Real(
    final quantity="PercentRate", final unit="%/s",
    nominal=100) "Rate of a share of full deflection"
  annotation(Documentation(info="<html>
<p>Derivative of a share in percent.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
