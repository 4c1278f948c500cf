within HydraulicTestBench.UsersGuide;
class AddAnEffect "How to add a physical effect"
  extends Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<ol>
<li>Find the slot whose filling sees what the effect depends on and gives what it acts on (<code>Slots</code>).</li>
<li>Write one class: extend the slot's partial class, declare the strength as a parameter whose off value makes the term
exactly zero, and give the missing equations. Keep it smooth; use an event only where the physics has one.</li>
<li>Extend <code>Pump.SwashPlateControl</code> and redeclare the slot, all slots in one such extension.</li>
</ol>
<pre>
model PistonCoulomb &quot;Dry friction at the control piston&quot;
  extends HydraulicTestBench.Interfaces.PartialPistonForce;
  parameter HydraulicTestBench.Types.Force F_c(min=0) = 0 &quot;Friction force, 0 = off&quot;;
  constant HydraulicTestBench.Types.Velocity v_t = 1e-3 &quot;Width of the sign change&quot;;
equation
  f = -F_c*tanh(v/v_t);
end PistonCoulomb;

model PumpWithFriction &quot;Locked parameter set, with dry friction&quot;
  extends HydraulicTestBench.Pump.SwashPlateControl(
    data=HydraulicTestBench.Data.LockedGreyBox(),
    redeclare PistonCoulomb pistonForce(F_c=80));
end PumpWithFriction;
</pre>
<p>The strength appears in the FMU as <code>pistonForce.F_c</code>. Nothing of the pump is touched or copied.</p>
<p><b>Extend SwashPlateControl itself,</b> or redeclare where the pump is a component
(<code>FreeGreyBox pump(redeclare PistonCoulomb pistonForce(F_c=80))</code>). Modelica also allows
<code>extends FreeGreyBox(redeclare ...)</code>, but the compiler behind <code>fmu-build</code> (rumoca 0.10.2) passes
over a
redeclaration of a slot that the extended class has itself inherited, without a word. For the same reason a second
effect is
added to the same extension, not by extending the first extension.</p>
<p><b>Two effects in one slot:</b> a class that extends the same partial class, holds both effects as components,
hands its
inputs to both and adds their forces or flows; signals go through one after the other.</p>
<pre>
model PistonPreload &quot;Preload of the centring springs&quot;
  extends HydraulicTestBench.Interfaces.PartialPistonForce;
  parameter HydraulicTestBench.Types.Force F_0(min=0) = 0 &quot;Preload, 0 = off&quot;;
  constant HydraulicTestBench.Types.Length x_t = 0.2e-3 &quot;Width of the sign change&quot;;
equation
  f = -F_0*tanh(x/x_t);
end PistonPreload;

model FrictionAndPreload &quot;Both forces at once&quot;
  extends HydraulicTestBench.Interfaces.PartialPistonForce;
  PistonCoulomb friction(F_c=80) &quot;First&quot;;
  PistonPreload preload(F_0=50) &quot;Second&quot;;
equation
  friction.x = x;
  friction.v = v;
  preload.x = x;
  preload.v = v;
  f = friction.f + preload.f;
end FrictionAndPreload;

model PumpWithBoth &quot;Free parameter set, with dry friction and preload&quot;
  extends HydraulicTestBench.Pump.SwashPlateControl(redeclare FrictionAndPreload pistonForce);
end PumpWithBoth;
</pre>
<p><b>States in a filling</b> get a start value with <code>fixed=true</code>, so that the start of the model stays
defined.</p>
<p><b>Check it:</b> with the strength off, the response is that of the base model to the last digit; with it on, the
sign is
right (<code>Signs</code>); the model stays balanced.</p>
<p><b>Source:</b> Modelica Language Specification 3.6, Section 7.3 (redeclaration).</p>
</html>"));
end AddAnEffect;
