within HydraulicTestBench.Types;
type MomentOfInertia = Real(
    final quantity="MomentOfInertia", final unit="kg.m2",
    min=0, nominal=0.1) "Moment of inertia"
  annotation(Documentation(info="<html>
<p>About the axis of rotation.</p>
<p><b>Source:</b> thesis, Table 5.1; the numbers inside a model are SI units.</p>
</html>"));
