within HydraulicTestBench.Interfaces;
connector Port_b "Hydraulic port (design outlet)"
  Types.Pressure p "Gauge pressure at the port";
  flow Types.VolumeFlowRate q "Volume flow, positive into the component";
  annotation(
    defaultComponentName="port_b",
    Icon(coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={Ellipse(extent={{-100, 100}, {100, -100}},
      lineColor={0, 100, 160}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>Where oil enters or leaves a component. The pressure is <b>gauge</b>: 0 is the surrounding air. The flow is in m3/s
and positive into the component. <code>Port_a</code> and <code>Port_b</code> differ by their icon alone; oil may flow
either way.</p>
<p><b>Source:</b> thesis Eq. 3.1 to 3.6, which take pressures above tank pressure 0 (Table 5).</p>
<p><b>Leaves out:</b> density and temperature of the flow: volume is conserved at a node, mass is not. With pressures
below 400 bar and a bulk modulus of 1400 MPa the difference stays below 3 percent.</p>
</html>"));
end Port_b;
