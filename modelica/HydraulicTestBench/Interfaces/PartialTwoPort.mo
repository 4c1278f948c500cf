within HydraulicTestBench.Interfaces;
partial model PartialTwoPort "Two hydraulic ports with the same flow through both"
  extends Icons.Slot;
  Port_a port_a "Inlet at positive flow"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Port_b port_b "Outlet at positive flow"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  Types.Pressure dp "Pressure difference port_a.p - port_b.p";
  Types.VolumeFlowRate q "Flow from port_a to port_b";
equation
  dp = port_a.p - port_b.p;
  q = port_a.q;
  port_a.q + port_b.q = 0;
  annotation(Documentation(info="<html>
<p>Nothing is stored inside. The law is one equation between q and dp; a law of the two pressures themselves uses
<code>port_a.p</code> and <code>port_b.p</code>.</p>
<p><b>Source:</b> thesis Eq. 3.6 (signs).</p>
<p><b>Used by:</b> <code>internalLeakage</code> of <code>Pump.SwashPlateControl</code>,
<code>Hydraulics.Orifice</code>.</p>
</html>"));
end PartialTwoPort;
