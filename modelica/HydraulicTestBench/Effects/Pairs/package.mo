within HydraulicTestBench.Effects;
package Pairs "Two effects in one slot"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>The annotation <code>pair</code> names the slot. <code>first</code> and <code>second</code> take any filling of it, a
pair again where three effects meet; where the effects cannot be kept apart, one class has the parameters of both and
says of which (<code>of</code>).</p>
<p><b>Source:</b> this library.</p>
</html>"));
end Pairs;
