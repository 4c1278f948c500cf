within HydraulicTestBench.Hydraulics;
model Tank "Constant pressure whatever flows, thesis Eq. 3.1"
  extends Icons.Component;
  parameter Types.Pressure p = 0 "Pressure";
  Interfaces.Port_a port "To the circuit"
    annotation(Placement(transformation(extent={{-10, 90}, {10, 110}})));
equation
  port.p = p;
  annotation(Documentation(info="<html>
<p>p<sub>T</sub> of the valve equations; any other constant pressure as well.</p>
<p><b>Source:</b> thesis Eq. 3.1 and Table 5.</p>
<p><b>Leaves out:</b> the return line.</p>
</html>"));
end Tank;
