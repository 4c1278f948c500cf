within HydraulicTestBench.Types;
type SpoolVelocity = Real(
    final quantity="SpoolVelocity", final unit="1/s",
    nominal=10) "Spool velocity in openings per second"
  annotation(Documentation(info="<html>
<p>Derivative of a spool position.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
