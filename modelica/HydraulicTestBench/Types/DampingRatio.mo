within HydraulicTestBench.Types;
type DampingRatio = Real(
    final quantity="DampingRatio", final unit="1",
    min=0, nominal=1) "Damping ratio"
  annotation(Documentation(info="<html>
<p>Eq. 3.19.</p>
<p><b>Source:</b> thesis; the numbers inside a model are SI units.</p>
</html>"));
