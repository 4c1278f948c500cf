within HydraulicTestBench.Types;
type Pressure = Real(
    final quantity="Pressure", final unit="Pa", displayUnit="bar",
    nominal=1e6) "Gauge pressure"
  annotation(Documentation(info="<html>
<p>Every pressure of this library is gauge: 0 is the surrounding air. It has no lower bound, since the model has no
cavitation.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
