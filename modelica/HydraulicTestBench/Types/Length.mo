within HydraulicTestBench.Types;
type Length = Real(
    final quantity="Length", final unit="m", displayUnit="mm",
    nominal=1e-2) "Length or position"
  annotation(Documentation(info="<html>
<p>The control piston's position is 0 in the middle of its stroke.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
