within HydraulicTestBench.Validation;
model PayloadFall "Payload that sinks on a slack wire, and one that hangs"
  extends Icons.Example;
  constant Data.Crane crane = Data.Crane() "Numbers of the crane";
  Crane.Payload falling(
    m_PL=crane.m_PL, V_PL=crane.V_PL, A_PL=crane.A_PL, C_d=crane.C_d, rho_s=crane.rho_s, g=crane.g) "Sinks"
    annotation(Placement(transformation(extent={{-60, -20}, {-20, 20}})));
  Crane.IdealCompensation hanging "Hangs on a vessel that heaves"
    annotation(Placement(transformation(extent={{20, -20}, {60, 20}})));
  Types.Velocity v_exact = -v_end*tanh(W*time/(crane.m_PL*v_end)) "Closed form";
  Types.Velocity error = falling.v_PL - v_exact "Difference from the closed form";
  Types.Length error_hanging = hanging.z_PL + W/hanging.k_w "Height of the one that hangs, from where it began";
  Types.Pressure error_p = hanging.pL_ref - W*hanging.r_d*2*Constants.pi/60e-6 "Its load pressure, from a constant";
protected
  final parameter Types.Force W = (crane.m_PL - crane.rho_s*crane.V_PL)*crane.g "Weight in water";
  final parameter Types.Velocity v_end = sqrt(2*W/(crane.rho_s*crane.C_d*crane.A_PL)) "Velocity in the end";
equation
  hanging.z_v_t = 0.5*sin(0.7*time);
  annotation(
    experiment(StartTime=0, StopTime=5, Interval=0.01, Tolerance=1e-8),
    Documentation(info="<html>
<p>Weight less buoyancy against a drag with the square of velocity: v = v<sub>end</sub> tanh(W t/(m v<sub>end</sub>)).
The one that hangs does not notice the heave, and its load pressure is that of its weight (Eq. 5.51).</p>
<p><b>Source:</b> thesis Eq. 5.44 to 5.51 with weight and sign, solved by hand.</p>
</html>"));
end PayloadFall;
