within HydraulicTestBench.Types;
type DampingConstant = Real(
    final quantity="TranslationalDampingConstant", final unit="N.s/m", displayUnit="N.s/mm",
    min=0, nominal=1e4) "Translational damping constant"
  annotation(Documentation(info="<html>
<p>Eq. 3.9.</p>
<p><b>Source:</b> thesis; the numbers inside a model are SI units.</p>
</html>"));
