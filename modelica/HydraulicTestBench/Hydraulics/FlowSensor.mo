within HydraulicTestBench.Hydraulics;
model FlowSensor "Ideal flow meter"
  extends Icons.Component;
  extends Interfaces.PartialTwoPort;
  Interfaces.RealOutput Q(unit="m3/s") "Flow from port_a to port_b"
    annotation(Placement(transformation(extent={{-10, 100}, {10, 120}})));
equation
  dp = 0;
  Q = q;
  annotation(Documentation(info="<html>
<p>Reads the flow through a line, without loss of pressure.</p>
<p><b>Source:</b> thesis Appendix D.7 (turbines for 1.2 to 20 and 40 to 600 l/min with less than 2 percent of
error).</p>
<p><b>Leaves out:</b> pressure loss, inertia, error and range of the real one; <code>pysim bench</code> adds those.</p>
</html>"));
end FlowSensor;
