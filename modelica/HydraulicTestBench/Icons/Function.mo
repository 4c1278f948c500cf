within HydraulicTestBench.Icons;
partial function Function "Icon of a function"
  annotation(
    Icon(coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={Ellipse(extent={{-100, 100}, {100, -100}}, lineColor={0, 60, 100}, fillColor={255, 255, 255},
      fillPattern=FillPattern.Solid), Text(extent={{-80, 80}, {80, -80}}, textString="f", textColor={0, 60, 100})}),
    Documentation(info="<html>
<p>Drawing only: no variable, no equation.</p>
<p><b>Source:</b> this library.</p>
</html>"));
end Function;
