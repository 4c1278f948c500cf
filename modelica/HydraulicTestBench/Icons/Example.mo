within HydraulicTestBench.Icons;
partial model Example "Icon of a model that can be run"
  annotation(
    Icon(coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={Ellipse(extent={{-100, 100}, {100, -100}}, lineColor={75, 138, 73}, fillColor={255, 255, 255},
      fillPattern=FillPattern.Solid), Polygon(points={{-40, 60}, {60, 0}, {-40, -60}}, lineColor={75, 138, 73},
      fillColor={75, 138, 73}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>Drawing only: no variable, no equation.</p>
<p><b>Source:</b> this library.</p>
</html>"));
end Example;
