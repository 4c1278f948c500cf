within HydraulicTestBench.Types;
type Area = Real(
    final quantity="Area", final unit="m2", displayUnit="mm2",
    nominal=1e-6) "Area"
  annotation(Documentation(info="<html>
<p>Piston areas, and opening areas with the discharge coefficient inside.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
