within HydraulicTestBench.Icons;
partial package Package "Icon of a package"
  annotation(
    Icon(coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={Rectangle(extent={{-100, 100}, {100, -100}},
        lineColor={120, 120, 120}, fillColor={240, 240, 235}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>Drawing only: no variable, no equation.</p>
<p><b>Source:</b> this library.</p>
</html>"));
end Package;
