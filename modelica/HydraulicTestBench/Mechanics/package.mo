within HydraulicTestBench;
package Mechanics "Shafts, friction, sensors; drum, wire and mass"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>One-dimensional rotation with the flanges of <code>Interfaces</code>. <code>Shaft</code> is the model of thesis
Fig. 5.12, two torques on an inertia with friction; <code>DrivenShaft</code> is the same under a drive that holds a
speed, for tests of its friction.
<code>Drum</code>, <code>Wire</code> and <code>Mass</code> move along a line, at the flanges
<code>TranslationFlange_a</code> and <code>_b</code>.</p>
<p><b>Source:</b> thesis Sections 5.1, 5.5 and 5.7.</p>
</html>"));
end Mechanics;
