within HydraulicTestBench.Types;
type VolumeFlowRate = Real(
    final quantity="VolumeFlowRate", final unit="m3/s", displayUnit="l/min",
    nominal=1e-4) "Volume flow rate"
  annotation(Documentation(info="<html>
<p>At a port it is positive into the component.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
