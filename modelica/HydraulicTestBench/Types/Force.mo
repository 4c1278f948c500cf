within HydraulicTestBench.Types;
type Force = Real(
    final quantity="Force", final unit="N",
    nominal=1000) "Force"
  annotation(Documentation(info="<html>
<p>Positive in the direction of the position it acts on.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
