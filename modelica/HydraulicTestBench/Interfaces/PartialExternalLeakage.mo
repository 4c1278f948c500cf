within HydraulicTestBench.Interfaces;
partial model PartialExternalLeakage "Slot for leakage of each chamber to the tank"
  extends Icons.Slot;
  Port_a port_1 "At chamber 1"
    annotation(Placement(transformation(extent={{-60, 90}, {-40, 110}})));
  Port_a port_2 "At chamber 2"
    annotation(Placement(transformation(extent={{40, 90}, {60, 110}})));
  Port_b port_T "At the tank"
    annotation(Placement(transformation(extent={{-10, -110}, {10, -90}})));
  Types.Pressure p1 "Pressure of chamber 1 above the tank";
  Types.Pressure p2 "Pressure of chamber 2 above the tank";
  Types.VolumeFlowRate q1 "Flow from chamber 1 to the tank";
  Types.VolumeFlowRate q2 "Flow from chamber 2 to the tank";
equation
  p1 = port_1.p - port_T.p;
  p2 = port_2.p - port_T.p;
  q1 = port_1.q;
  q2 = port_2.q;
  port_1.q + port_2.q + port_T.q = 0;
  annotation(Documentation(info="<html>
<p>Both chambers are sealed alike, so one class with one parameter serves both; the law is two equations, for q1 and q2.
In the base model both are 0.</p>
<p><b>Source:</b> thesis Eq. 3.4 and 3.5, beside Q<sub>Leak</sub>.</p>
<p><b>Used by:</b> <code>externalLeakage</code> of <code>Pump.SwashPlateControl</code>.</p>
</html>"));
end PartialExternalLeakage;
