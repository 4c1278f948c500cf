within HydraulicTestBench.Hydraulics;
model PrescribedPressure "Pressure that a signal prescribes, whatever flows"
  extends Icons.Component;
  Interfaces.RealInput p(unit="Pa") "Pressure"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.Port_b port "To the circuit"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
equation
  port.p = p;
  annotation(Documentation(info="<html>
<p>An ideal pressure source; for a constant pressure <code>Tank</code> does.</p>
<p><b>Source:</b> this library, for tests of other components and for joining circuits of two programs.</p>
<p><b>Valid:</b> at parts that give a flow from pressures. At a <code>Volume</code> its derivative would be needed,
which
a signal from outside does not bring.</p>
</html>"));
end PrescribedPressure;
