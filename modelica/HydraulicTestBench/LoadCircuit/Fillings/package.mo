within HydraulicTestBench.LoadCircuit;
package Fillings "Physics for the slots of the test bench"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>Each is exactly off where its strength is 0 (<code>MotorLeakage</code>, <code>MotorTorqueLoss</code>,
<code>ShaftFriction</code>) or brings a part that cannot be off (<code>SecondVolume</code>; for the slot
<code>coupling</code>, <code>Mechanics.Coupling</code>). Overlap of the servo valve is
<code>Effects.ValveDeadband</code> in
the slot <code>servoOpening</code>.</p>
<p><b>Source:</b> each class names its own.</p>
</html>"));
end Fillings;
