within HydraulicTestBench.Interfaces;
connector RealInput = input Real "Signal into a component"
  annotation(
    defaultComponentName="u",
    Icon(coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={Polygon(points={{-100, 100}, {100, 0}, {-100, -100}}, lineColor={0, 0, 127}, fillColor={0, 0, 127},
      fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>One real number. Same as <code>Modelica.Blocks.Interfaces.RealInput</code>: the two can be connected.</p>
<p><b>Source:</b> Modelica Language Specification 3.6, Section 9.1 (signal connectors).</p>
</html>"));
