within HydraulicTestBench.Icons;
partial class Slot "Icon of a class that fills a slot"
  annotation(
    Icon(coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={Rectangle(extent={{-100, 100}, {100, -100}},
        lineColor={0, 60, 100}, fillColor={255, 250, 225}, fillPattern=FillPattern.Solid),
      Text(extent={{-150, 150}, {150, 110}}, textString="%name", textColor={0, 0, 255})}),
    Documentation(info="<html>
<p>Drawing only: no variable, no equation.</p>
<p><b>Source:</b> this library.</p>
</html>"));
end Slot;
