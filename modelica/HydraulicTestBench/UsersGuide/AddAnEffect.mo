within HydraulicTestBench.UsersGuide;
class AddAnEffect "How to add a physical effect"
  extends Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<p>The effects that come along are in <code>Effects</code>: look there first, and at one of its classes as a pattern. An
effect of your own takes four steps:</p>
<ol>
<li>Find the slot whose filling sees what the effect depends on and gives what it acts on (<code>Slots</code>).</li>
<li>Write one class: extend the slot's partial class, declare the strength as a parameter whose off value makes the term
exactly zero, and give the missing equations. Keep it smooth; use an event only where the physics has one.</li>
<li>Say in the class's annotation what it is: <code>__HydraulicTestBench(effect=\"my.friction\",
slot=\"pistonForce\")</code>, with a name of your own. Give each parameter a unit, <code>min</code>, <code>max</code>
and <code>nominal</code>. Then <code>pysim diagnose measurements --model YourModel --library YourLibrary</code> finds
it, and it takes part beside the others wherever a model has that slot.</li>
<li>To use it by hand, extend <code>Pump.SwashPlateControl</code> and redeclare the slot, all slots in one such
extension.</li>
</ol>
<pre>
model PistonCoulomb &quot;Dry friction at the control piston&quot;
  extends HydraulicTestBench.Interfaces.PartialPistonForce;
  parameter HydraulicTestBench.Types.Force F_c(min=0, max=500, nominal=80) = 0 &quot;Friction force, 0 = off&quot;;
  constant HydraulicTestBench.Types.Velocity v_t = 1e-3 &quot;Width of the sign change&quot;;
equation
  f = -F_c*tanh(v/v_t);
  annotation(__HydraulicTestBench(effect=&quot;my.friction&quot;, slot=&quot;pistonForce&quot;));
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
<code>extends FreeGreyBox(redeclare ...)</code>, but the compiler behind <code>fmu-build</code> (rumoca 0.10.2) would
drop the redeclaration of a slot that the extended class has itself inherited; <code>fmu-build</code> refuses it, with
file and line. For the same reason a second effect is
added to the same extension, not by extending the first extension.</p>
<p><b>Two effects in one slot:</b> <code>Effects.Pairs</code> has a class for each slot that several effects want.
Forces add; signals go through one after the other. Where a slot of your own needs one, hold both effects as
components, hand them the inputs, add their outputs, and annotate it with <code>pair</code>, as the classes there
do.</p>
<pre>
model FrictionAndPreload &quot;Both forces at once&quot;
  extends HydraulicTestBench.Effects.Pairs.PistonForces(
    redeclare PistonCoulomb first(F_c=80),
    redeclare HydraulicTestBench.Effects.SpringPreload second(F_0=50));
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
