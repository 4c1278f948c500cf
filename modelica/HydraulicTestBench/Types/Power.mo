within HydraulicTestBench.Types;
type Power = Real(
    final quantity="Power", final unit="W", displayUnit="kW",
    nominal=1e3) "Power"
  annotation(Documentation(info="<html>
<p>Pressure times volume flow, or torque times speed.</p>
<p><b>Source:</b> this library; the numbers inside a model are SI units.</p>
</html>"));
