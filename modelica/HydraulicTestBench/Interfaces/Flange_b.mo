within HydraulicTestBench.Interfaces;
connector Flange_b "Rotational flange, driven side"
  Types.Angle phi "Absolute rotation angle of the flange";
  flow Types.Torque tau "Cut torque, positive into the component";
  annotation(
    defaultComponentName="flange_b",
    Icon(coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={Ellipse(extent={{-100, 100}, {100, -100}},
      lineColor={95, 95, 95}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>Same variables, units and signs as <code>Modelica.Mechanics.Rotational.Interfaces.Flange_b</code>: the two can be
connected. <code>Flange_a</code> and <code>Flange_b</code> differ by their icon alone.</p>
<p><b>Source:</b> Modelica Standard Library 4, Mechanics.Rotational (variables, units and signs).</p>
</html>"));
end Flange_b;
