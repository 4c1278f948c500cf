within HydraulicTestBench.Hydraulics;
model FlowSource "Constant flow whatever the pressure"
  extends Icons.Component;
  parameter Types.VolumeFlowRate q "Flow delivered";
  Interfaces.Port_b port "To the circuit"
    annotation(Placement(transformation(extent={{-10, 90}, {10, 110}})));
equation
  port.q = -q;
  annotation(Documentation(info="<html>
<p>An ideal displacement pump.</p>
<p><b>Source:</b> this library, for tests of other components.</p>
<p><b>Leaves out:</b> leakage, and any limit of pressure.</p>
</html>"));
end FlowSource;
