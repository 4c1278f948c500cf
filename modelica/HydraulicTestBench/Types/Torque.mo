within HydraulicTestBench.Types;
type Torque = Real(
    final quantity="Torque", final unit="N.m",
    nominal=100) "Torque"
  annotation(Documentation(info="<html>
<p>At a flange it is the cut torque, positive into the component.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
