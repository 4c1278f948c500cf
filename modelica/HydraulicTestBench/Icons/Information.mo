within HydraulicTestBench.Icons;
partial class Information "Icon of a page of the guide"
  annotation(
    Icon(coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={Ellipse(extent={{-100, 100}, {100, -100}}, lineColor={0, 90, 160}, fillColor={0, 90, 160},
      fillPattern=FillPattern.Solid), Text(extent={{-80, 80}, {80, -80}}, textString="i", textColor={255, 255, 255})}),
    Documentation(info="<html>
<p>Drawing only: no variable, no equation.</p>
<p><b>Source:</b> this library.</p>
</html>"));
end Information;
