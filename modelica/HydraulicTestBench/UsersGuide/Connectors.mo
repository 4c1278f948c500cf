within HydraulicTestBench.UsersGuide;
class Connectors "Connectors, and how they meet other libraries"
  extends Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<table border=\"1\">
<tr><th>connector</th><th>across</th><th>flow</th><th>joins</th></tr>
<tr><td>Interfaces.RealInput, RealOutput</td><td colspan=\"2\">one Real</td><td>Modelica.Blocks.Interfaces.RealInput,
RealOutput</td></tr>
<tr><td>Interfaces.Flange_a, Flange_b</td><td>phi (rad)</td><td>tau (N.m)</td>
<td>Modelica.Mechanics.Rotational.Interfaces.Flange_a, Flange_b</td></tr>
<tr><td>Interfaces.TranslationFlange_a, TranslationFlange_b</td><td>s (m)</td><td>f (N)</td>
<td>Modelica.Mechanics.Translational.Interfaces.Flange_a, Flange_b</td></tr>
<tr><td>Interfaces.Port_a, Port_b</td><td>p (Pa, gauge)</td><td>q (m3/s)</td><td>this library</td></tr>
</table>
<p>Connectors are joined by the names of their variables, so the Modelica Standard Library need not be loaded to use
this
library, and can be loaded beside it.</p>
<p><b>Source:</b> Modelica Standard Library 4; Modelica Language Specification 3.6, Section 9.</p>
</html>"));
end Connectors;
