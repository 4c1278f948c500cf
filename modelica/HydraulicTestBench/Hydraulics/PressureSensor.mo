within HydraulicTestBench.Hydraulics;
model PressureSensor "Ideal pressure transmitter"
  extends Icons.Component;
  Interfaces.Port_a port "Where the pressure is measured; nothing flows"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.RealOutput p(unit="Pa") "Gauge pressure"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
equation
  port.q = 0;
  p = port.p;
  annotation(Documentation(info="<html>
<p>Reads the pressure of a node.</p>
<p><b>Source:</b> thesis Appendix D.8 (a transmitter for 0 to 400 bar with less than 0.5 percent of error).</p>
<p><b>Leaves out:</b> lag, error and range of the real one; <code>pysim bench</code> adds those.</p>
</html>"));
end PressureSensor;
