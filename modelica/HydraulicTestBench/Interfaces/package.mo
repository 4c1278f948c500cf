within HydraulicTestBench;
package Interfaces "Connectors, and the partial classes of the slots"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>A partial class owns connectors, signs and balance; the class that extends it adds its law alone. How many equations
that are is said in each. <code>Neutral</code> holds what the base model puts into a slot.</p>
<p><b>Source:</b> thesis Section 3.2 and 3.3 for the places and signs; see <code>UsersGuide.AddAnEffect</code>.</p>
</html>"));
end Interfaces;
