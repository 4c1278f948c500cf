within HydraulicTestBench.Types;
type SpoolPosition = Real(
    final quantity="SpoolPosition", final unit="1",
    nominal=0.1) "Spool position or command, -1 ... 1 of full opening"
  annotation(Documentation(info="<html>
<p>Dimensionless, as in Eq. 3.3 and 3.19.</p>
<p><b>Source:</b> thesis; the numbers inside a model are SI units.</p>
</html>"));
