within HydraulicTestBench.Effects;
model MotorTorqueLoss "A share of each motor's hydraulic torque is lost, against the motion (motor.torque_loss)"
  extends Interfaces.PartialMotorLoss;
  parameter Real eta(final unit="1", min=0, max=0.5, nominal=0.1) = 0 "Share lost, 0 = off";
  constant Types.AngularVelocity w_t = 0.1 "Width of the sign change";
equation
  tau_s = eta*abs(T_s)*tanh(w_s/w_t);
  tau_L = eta*abs(T_L)*tanh(w_L/w_t);
  annotation(__HydraulicTestBench(effect="motor.torque_loss", slot="motorLoss"), Documentation(info="<html>
<p>&tau; = &eta; |T| tanh(&omega;/&omega;<sub>t</sub>) in both motors.</p>
<p><b>Source:</b> this library; beside thesis Eq. 5.8 and 5.20.</p>
<p><b>Valid:</b> either direction, driving and driven; below &omega;<sub>t</sub> the shaft creeps instead of standing
still.</p>
<p><b>Leaves out:</b> friction without pressure, which is <code>ShaftFriction</code>.</p>
</html>"));
end MotorTorqueLoss;
