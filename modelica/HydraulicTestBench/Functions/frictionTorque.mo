within HydraulicTestBench.Functions;
function frictionTorque "Friction that falls from stiction to Coulomb friction, smooth at standstill, thesis Eq. 5.38"
  extends Icons.Function;
  input Types.AngularVelocity omega "Speed";
  input Real r(unit="s/rad") "Steepness at standstill";
  input Types.AngularVelocity omega_0 "Speed over which stiction fades, above 0";
  input Types.Torque tau_c "Coulomb friction, what is left at high speed";
  input Types.Torque tau_s "Stiction, the largest friction near standstill";
  output Types.Torque tau "Friction torque, with the sign of omega";
algorithm
  tau := tanh(r*omega)*(tau_c + (tau_s - tau_c)*exp(-abs(omega)/omega_0));
  annotation(Inline=true, Documentation(info="<html>
<p>&tau; = tanh(r&omega;) (&tau;<sub>c</sub> + (&tau;<sub>s</sub> - &tau;<sub>c</sub>)
e<sup>-|&omega;|/&omega;<sub>0</sub></sup>).</p>
<p><b>Source:</b> thesis Eq. 5.38.</p>
<p><b>Valid:</b> any speed. The first derivative is continuous; the second jumps at standstill.</p>
<p><b>Leaves out:</b> true sticking: below &tau;<sub>s</sub> the shaft creeps instead of standing still. Viscous
friction.</p>
</html>"));
end frictionTorque;
