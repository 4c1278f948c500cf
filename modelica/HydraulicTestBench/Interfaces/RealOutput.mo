within HydraulicTestBench.Interfaces;
connector RealOutput = output Real "Signal out of a component"
  annotation(
    defaultComponentName="y",
    Icon(coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={Polygon(points={{-100, 100}, {100, 0}, {-100, -100}}, lineColor={0, 0, 127}, fillColor={255, 255, 255},
      fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>One real number. Same as <code>Modelica.Blocks.Interfaces.RealOutput</code>: the two can be connected.</p>
<p><b>Source:</b> Modelica Language Specification 3.6, Section 9.1 (signal connectors).</p>
</html>"));
