within HydraulicTestBench.Types;
type KinematicViscosity = Real(
    final quantity="KinematicViscosity", final unit="m2/s", displayUnit="mm2/s",
    min=0, nominal=1e-5) "Kinematic viscosity"
  annotation(Documentation(info="<html>
<p>Viscosity over density; 1 mm2/s is 1 cSt.</p>
<p><b>Source:</b> this library; the numbers inside a model are SI units.</p>
</html>"));
