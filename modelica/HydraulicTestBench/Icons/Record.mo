within HydraulicTestBench.Icons;
partial record Record "Icon of a record of parameters"
  annotation(
    Icon(coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={Rectangle(extent={{-100, 100}, {100, -100}},
        lineColor={160, 120, 0}, fillColor={255, 255, 235}, fillPattern=FillPattern.Solid),
      Line(points={{-100, 30}, {100, 30}}), Line(points={{0, 100}, {0, -100}})}),
    Documentation(info="<html>
<p>Drawing only: no variable, no equation.</p>
<p><b>Source:</b> this library.</p>
</html>"));
end Record;
