within HydraulicTestBench.Types;
type SpoolAcceleration = Real(
    final quantity="SpoolAcceleration", final unit="1/s2",
    nominal=1000) "Spool acceleration in openings per second squared"
  annotation(Documentation(info="<html>
<p>Second derivative of a spool position.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
