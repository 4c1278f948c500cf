within HydraulicTestBench.Interfaces;
partial model PartialMotorLeakage "Slot for leakage across the two motors of the test bench"
  extends Icons.Slot;
  Port_a port_sA "Port A of the supply motor"
    annotation(Placement(transformation(extent={{-110, 50}, {-90, 70}})));
  Port_b port_sB "Port B of the supply motor"
    annotation(Placement(transformation(extent={{90, 50}, {110, 70}})));
  Port_a port_LA "Port A of the load motor"
    annotation(Placement(transformation(extent={{-110, -70}, {-90, -50}})));
  Port_b port_LB "Port B of the load motor"
    annotation(Placement(transformation(extent={{90, -70}, {110, -50}})));
  Types.Pressure p_s "Pressure across the supply motor";
  Types.Pressure p_L "Pressure across the load motor";
  Types.VolumeFlowRate q_s "Leakage across the supply motor";
  Types.VolumeFlowRate q_L "Leakage across the load motor";
equation
  p_s = port_sA.p - port_sB.p;
  p_L = port_LA.p - port_LB.p;
  port_sA.q = q_s;
  port_LA.q = q_L;
  port_sA.q + port_sB.q = 0;
  port_LA.q + port_LB.q = 0;
  annotation(Documentation(info="<html>
<p>Both motors are of one kind, so one class with one parameter serves both; the law is two equations, for q_s and
q_L. In
the base model both are 0.</p>
<p><b>Source:</b> thesis Eq. 5.7 and 5.19, beside K&omega;.</p>
<p><b>Used by:</b> <code>motorLeakage</code> of <code>LoadCircuit.OpenTestBench</code>.</p>
</html>"));
end PartialMotorLeakage;
