within HydraulicTestBench.Interfaces;
partial model PartialHoses "Slot for what hangs on the four lines of the test bench"
  extends Icons.Slot;
  Port_a port_sA "Line A of the supply circuit"
    annotation(Placement(transformation(extent={{-110, 50}, {-90, 70}})));
  Port_a port_sB "Line B of the supply circuit"
    annotation(Placement(transformation(extent={{90, 50}, {110, 70}})));
  Port_a port_LA "Line A of the load circuit"
    annotation(Placement(transformation(extent={{-110, -70}, {-90, -50}})));
  Port_a port_LB "Line B of the load circuit"
    annotation(Placement(transformation(extent={{90, -70}, {110, -50}})));
  annotation(Documentation(info="<html>
<p>The lines are of one kind, so one class serves all four; the law is four equations, one for the flow into each port.
In the base model nothing flows.</p>
<p><b>Source:</b> thesis Eq. 5.10 and 5.23, beside the dead volumes.</p>
<p><b>Used by:</b> <code>hoses</code> of <code>LoadCircuit.OpenTestBench</code>.</p>
</html>"));
end PartialHoses;
