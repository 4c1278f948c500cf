within HydraulicTestBench.Types;
type SpringConstant = Real(
    final quantity="TranslationalSpringConstant", final unit="N/m", displayUnit="N/mm",
    min=0, nominal=1e4) "Translational spring constant"
  annotation(Documentation(info="<html>
<p>Eq. 3.9.</p>
<p><b>Source:</b> thesis; the numbers inside a model are SI units.</p>
</html>"));
