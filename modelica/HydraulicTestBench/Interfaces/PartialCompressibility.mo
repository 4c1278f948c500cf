within HydraulicTestBench.Interfaces;
partial model PartialCompressibility "Slot for what makes the oil in the two chambers softer"
  extends Icons.Slot;
  RealInput p1(unit="Pa") "Gauge pressure in chamber 1"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  RealInput p2(unit="Pa") "Gauge pressure in chamber 2"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  RealOutput kappa1(unit="1/Pa") "Compressibility added to 1/beta in chamber 1"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  RealOutput kappa2(unit="1/Pa") "Compressibility added to 1/beta in chamber 2"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
  annotation(Documentation(info="<html>
<p>In each chamber 1/&beta;<sub>eff</sub> = 1/&beta; + &kappa;. Both chambers hold the same oil, so one class with one
parameter serves both; the law is two equations. In the base model &kappa; = 0 and &beta;<sub>eff</sub> = &beta;. The
pressures are gauge: a law in absolute pressure adds that of the surrounding air.</p>
<p><b>Source:</b> thesis Eq. 3.4 and 3.5.</p>
<p><b>Used by:</b> <code>oil</code> of <code>Pump.SwashPlateControl</code>.</p>
</html>"));
end PartialCompressibility;
