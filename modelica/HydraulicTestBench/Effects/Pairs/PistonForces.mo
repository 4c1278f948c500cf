within HydraulicTestBench.Effects.Pairs;
model PistonForces "Two forces on the control piston"
  extends Interfaces.PartialPistonForce;
  replaceable Interfaces.Neutral.PistonForce first constrainedby Interfaces.PartialPistonForce "First effect"
    annotation(choicesAllMatching=true);
  replaceable Interfaces.Neutral.PistonForce second constrainedby Interfaces.PartialPistonForce "Second effect"
    annotation(choicesAllMatching=true);
equation
  first.x = x;
  first.v = v;
  second.x = x;
  second.v = v;
  f = first.f + second.f;
  annotation(__HydraulicTestBench(pair="pistonForce"), Documentation(info="<html>
<p>Both see position and velocity; the forces add.</p>
<p><b>Source:</b> this library.</p>
<p><b>Valid:</b> for any two fillings of the slot.</p>
</html>"));
end PistonForces;
