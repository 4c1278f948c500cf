within HydraulicTestBench.Effects;
package Smooth "Effects whose laws have events, written without: what a search takes in their place"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>The annotation <code>smooth</code> names the effect that a class stands in for. It has the same parameters and
slot. Its slopes are exact, and it runs faster; the model that is kept has the effect itself.</p>
<p><b>Source:</b> this library.</p>
</html>"));
end Smooth;
