within HydraulicTestBench.Effects;
model SwashBias "Constant force on the control piston (swash.bias)"
  extends Interfaces.PartialPistonForce;
  parameter Types.Force F_b(min=-500, max=500, nominal=100) = 0 "Force towards positive x, 0 = off";
equation
  f = F_b;
  annotation(__HydraulicTestBench(effect="swash.bias", slot="pistonForce"), Documentation(info="<html>
<p>f = F<sub>b</sub>: pistons of the pump that push the swash plate to one side.</p>
<p><b>Source:</b> joins the force balance, thesis Eq. 3.9.</p>
<p><b>Valid:</b> constant load and speed of the pump.</p>
<p><b>Leaves out:</b> its dependence on the pump's pressure and angle.</p>
</html>"));
end SwashBias;
