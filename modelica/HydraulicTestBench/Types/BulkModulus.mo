within HydraulicTestBench.Types;
type BulkModulus = Real(
    final quantity="BulkModulus", final unit="Pa", displayUnit="MPa",
    min=1e6, nominal=1e9) "Bulk modulus of oil"
  annotation(Documentation(info="<html>
<p>Oil stiffness &beta; of Eq. 3.4.</p>
<p><b>Source:</b> thesis; the numbers inside a model are SI units.</p>
</html>"));
