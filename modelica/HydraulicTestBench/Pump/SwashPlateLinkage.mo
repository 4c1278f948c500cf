within HydraulicTestBench.Pump;
block SwashPlateLinkage "Angle of the swash plate from the piston's position, thesis Eq. 3.10 to 3.12"
  extends Icons.Component;
  parameter Types.Length a "Distance of the piston rod from the swash plate's axis";
  Interfaces.RealInput x(unit="m") "Position of the slider"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  Interfaces.RealInput x_t(unit="m/s") "Velocity of the slider"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealInput x_tt(unit="m/s2") "Acceleration of the slider"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  Interfaces.RealOutput alpha(unit="rad") "Swash plate angle"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput alpha_t(unit="rad/s") "Angular velocity"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
  Types.AngularAcceleration alpha_tt "Angular acceleration";
equation
  alpha = atan(x/a);
  alpha_t = x_t*(1 + cos(2*alpha))/(2*a);
  alpha_tt = cos(alpha)*(cos(alpha)*x_tt - 2*alpha_t*sin(alpha)*x_t)/a;
  annotation(Documentation(info="<html>
<p>A slider in a slot: x = a tan(&alpha;), and its first two derivatives.</p>
<p><b>Source:</b> thesis Eq. 3.7, 3.10, 3.11, 3.12.</p>
<p><b>Valid:</b> any position; |&alpha;| stays below 90 degrees.</p>
<p><b>Leaves out:</b> elasticity and play of the linkage.</p>
</html>"));
end SwashPlateLinkage;
