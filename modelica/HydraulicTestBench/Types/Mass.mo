within HydraulicTestBench.Types;
type Mass = Real(
    final quantity="Mass", final unit="kg",
    min=1e-3, nominal=100) "Mass"
  annotation(Documentation(info="<html>
<p>Strictly positive, since it divides a force (Eq. 3.9).</p>
<p><b>Source:</b> thesis; the numbers inside a model are SI units.</p>
</html>"));
