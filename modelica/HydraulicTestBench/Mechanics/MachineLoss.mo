within HydraulicTestBench.Mechanics;
model MachineLoss "Torque lost in a pump or motor: dry, with pressure, and viscous"
  extends Interfaces.PartialTorqueLoss;
  parameter Types.Torque tau_0(min=0, max=100, nominal=1) = 0 "Dry friction at no pressure";
  parameter Types.Volume V_loss(min=0, max=5e-5, nominal=1e-6) = 0
    "Loss over pressure: displacement per revolution times the share lost";
  parameter Real c(final unit="N.m.s/rad", min=0, max=1, nominal=0.01) = 0 "Viscous friction";
  parameter Types.AngularVelocity w_t(min=1e-3) = 1 "Width of the sign change";
equation
  tau = tanh(w/w_t)*(tau_0 + V_loss/(2*Constants.pi)*abs(p_A - p_B)) + c*w;
  annotation(Documentation(info="<html>
<p>&tau; = tanh(&omega;/&omega;<sub>t</sub>) (&tau;<sub>0</sub> + V<sub>loss</sub> |p<sub>A</sub> -
p<sub>B</sub>|/2&pi;)
+ c&omega;. A machine of 71 cm3 that loses 5 percent of its hydraulic torque has V<sub>loss</sub> = 3.55 cm3. With all
three at 0 it is exactly off.</p>
<p><b>Source:</b> W. E. Wilson's loss terms, as in H. E. Merritt, Hydraulic Control Systems, Chapter 4.</p>
<p><b>Valid:</b> any speed and pressure.</p>
<p><b>Leaves out:</b> stiction, churning losses with the square of speed.</p>
</html>"));
end MachineLoss;
