within HydraulicTestBench;
package Mechanics "The shaft between the two motors: inertia, friction, speed sensor"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>One-dimensional rotation with the flanges of <code>Interfaces</code>. <code>Shaft</code> is the model of thesis
Fig. 5.12, two torques on an inertia with friction; <code>DrivenShaft</code> is the same under a drive that holds a
speed, for tests of its friction.</p>
<p><b>Source:</b> thesis Sections 5.1 and 5.5.</p>
</html>"));
end Mechanics;
