within HydraulicTestBench.UsersGuide;
class AddAnEffect "How to add a physical effect"
  extends Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<ol>
<li>Find the slot whose filling sees what the effect depends on and gives what it acts on (<code>Slots</code>).</li>
<li>Write one class: extend the slot's partial class, declare the strength as a parameter whose off value makes the term
exactly zero, and give the missing equations. Keep it smooth; use an event only where the physics has one.</li>
<li>Extend the pump and redeclare the slot.</li>
</ol>
<pre>
model PistonCoulomb &quot;Dry friction at the control piston&quot;
  extends HydraulicTestBench.Interfaces.PartialPistonForce;
  parameter HydraulicTestBench.Types.Force F_c(min=0) = 0 &quot;Friction force, 0 = off&quot;;
  constant HydraulicTestBench.Types.Velocity v_t = 1e-3 &quot;Width of the sign change&quot;;
equation
  f = -F_c*tanh(v/v_t);
end PistonCoulomb;

model PumpWithFriction
  extends HydraulicTestBench.Pump.FreeGreyBox(redeclare PistonCoulomb pistonForce(F_c=80));
end PumpWithFriction;
</pre>
<p>The strength appears in the FMU as <code>pistonForce.F_c</code>. Nothing of the pump is touched or copied.</p>
<p><b>Two effects in one slot:</b> a class that extends the same partial class, holds both effects as components,
hands its
inputs to both and adds their forces or flows; signals go through one after the other.</p>
<pre>
model FrictionAndPreload &quot;Both forces at once&quot;
  extends HydraulicTestBench.Interfaces.PartialPistonForce;
  PistonCoulomb friction &quot;First&quot;;
  PistonPreload preload &quot;Second&quot;;
equation
  friction.x = x;
  friction.v = v;
  preload.x = x;
  preload.v = v;
  f = friction.f + preload.f;
end FrictionAndPreload;
</pre>
<p><b>States in a filling</b> get a start value with <code>fixed=true</code>, so that the start of the model stays
defined.</p>
<p><b>Check it:</b> with the strength off, the response is that of the base model to the last digit; with it on, the
sign is
right (<code>Signs</code>); the model stays balanced.</p>
<p><b>Source:</b> Modelica Language Specification 3.6, Section 7.3 (redeclaration).</p>
</html>"));
end AddAnEffect;
