within HydraulicTestBench.Types;
type Duration = Real(
    final quantity="Time", final unit="s", displayUnit="ms",
    min=0, nominal=1e-3) "Time constant, dead time or lag"
  annotation(Documentation(info="<html>
<p>Not for the time of an experiment, which is in seconds throughout.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
