within HydraulicTestBench.Hydraulics;
model PrescribedFlow "Flow that a signal prescribes, whatever the pressure"
  extends Icons.Component;
  Interfaces.RealInput Q(unit="m3/s") "Flow into the circuit"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.Port_b port "To the circuit"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
equation
  port.q = -Q;
  annotation(Documentation(info="<html>
<p>An ideal flow source, taken from no reservoir in particular.</p>
<p><b>Source:</b> this library, for tests of other components and for joining circuits of two programs.</p>
<p><b>Leaves out:</b> leakage, and any limit of pressure.</p>
</html>"));
end PrescribedFlow;
