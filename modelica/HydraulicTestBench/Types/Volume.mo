within HydraulicTestBench.Types;
type Volume = Real(
    final quantity="Volume", final unit="m3", displayUnit="l",
    nominal=1e-4) "Volume"
  annotation(Documentation(info="<html>
<p>The litre is the dm3 of Table 4.6.</p>
<p><b>Source:</b> thesis; the numbers inside a model are SI units.</p>
</html>"));
