within HydraulicTestBench.Sources;
block Constant "One value at all times"
  extends Icons.Component;
  parameter Real k = 0 "Value, in the unit of what it is connected to";
  Interfaces.RealOutput y "The value"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
equation
  y = k;
  annotation(Documentation(info="<html>
<p>y = k. With its default it is the rate of a command whose rate is not known, at <code>alphaCMD_t</code>: an input of
a component needs something that gives its value, be it 0.</p>
<p><b>Source:</b> this library; rule: Modelica Language Specification 3.6, Section 4.7.</p>
<p><b>Valid:</b> at any input.</p>
</html>"));
end Constant;
