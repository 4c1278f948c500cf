within HydraulicTestBench.Interfaces;
connector TranslationFlange_b "Flange that moves along a line, driven side"
  Types.Length s "Absolute position of the flange";
  flow Types.Force f "Cut force, positive into the component";
  annotation(
    defaultComponentName="flange_b",
    Icon(coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={Rectangle(extent={{-100, 100}, {100, -100}},
      lineColor={0, 127, 0}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>Same variables, units and signs as <code>Modelica.Mechanics.Translational.Interfaces.Flange_b</code>: the two can be
connected. <code>TranslationFlange_a</code> and <code>TranslationFlange_b</code> differ by their icon alone.</p>
<p><b>Source:</b> Modelica Standard Library 4, Mechanics.Translational (variables, units and signs).</p>
</html>"));
end TranslationFlange_b;
