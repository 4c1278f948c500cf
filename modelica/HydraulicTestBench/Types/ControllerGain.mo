within HydraulicTestBench.Types;
type ControllerGain = Real(
    final quantity="ControllerGain", final unit="1",
    min=0, nominal=1) "Gain of a controller"
  annotation(Documentation(info="<html>
<p>K_p takes an angle in rad to a spool command, K_D a spool command to a spool command (Eq. 3.17, 3.18).</p>
<p><b>Source:</b> thesis; the numbers inside a model are SI units.</p>
</html>"));
