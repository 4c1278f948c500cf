within HydraulicTestBench;
package Effects "Physical effects that the base model lacks, each a filling for one slot"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>Each class says in its annotation <code>__HydraulicTestBench</code> which effect it is (its standard name) and which
slot of the model it fills. Its parameters say the rest: <code>min</code> and <code>max</code> are their bounds,
<code>nominal</code> a usual size. A parameter that is 0 as declared is a strength, and 0 is off: the equations are then
exactly those of the base model. Where off is a singular limit (a lag of 0 s) the annotation says
<code>bypass=true</code>: the neutral filling stands for off, and the effect tends to it as it shrinks.</p>
<p><code>inverse=\"u_max\"</code> at a parameter says that it is one over the quantity people speak of;
<code>limits=\"u\"</code> names the class' variable whose size that quantity limits.</p>
<p>The first eighteen are for the slots of the pump's control, the last six for those of
<code>LoadCircuit.OpenTestBench</code>.</p>
<p>Two effects in one slot are put together by a class of <code>Pairs</code>. A law with events has a class of
<code>Smooth</code> that stands in for it while effects are searched for.</p>
<p><b>Source:</b> each class names its own; <code>UsersGuide.AddAnEffect</code> shows how to write one.</p>
</html>"));
end Effects;
