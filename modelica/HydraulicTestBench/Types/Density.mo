within HydraulicTestBench.Types;
type Density = Real(
    final quantity="Density", final unit="kg/m3",
    min=1, nominal=1000) "Density"
  annotation(Documentation(info="<html>
<p>Density of oil, Eq. 3.1.</p>
<p><b>Source:</b> thesis; the numbers inside a model are SI units.</p>
</html>"));
