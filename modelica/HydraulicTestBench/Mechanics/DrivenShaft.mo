within HydraulicTestBench.Mechanics;
model DrivenShaft "Shaft under a drive that holds a speed, for tests of its friction"
  extends Icons.Component;
  parameter Real G(final unit="N.m.s/rad", min=1, nominal=10) = 20 "Gain of the drive, torque over error of speed";
  Interfaces.RealInput omega_ref(unit="rad/s", start=0) "Speed to hold; its sign is that of the measured speed"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  Interfaces.RealInput T_L(unit="N.m", start=0) "Torque of the load motor, against positive speed"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  Interfaces.RealOutput T_s(unit="N.m") "Torque of the drive"
    annotation(Placement(transformation(extent={{100, 70}, {120, 90}})));
  Interfaces.RealOutput theta(unit="rad") "Angle"
    annotation(Placement(transformation(extent={{100, 30}, {120, 50}})));
  Interfaces.RealOutput omega(unit="rad/s") "Speed"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  Interfaces.RealOutput omega_s(unit="rad/s") "Speed as the pulses tell it"
    annotation(Placement(transformation(extent={{100, -50}, {120, -30}})));
  Shaft shaft "Shaft"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}})));
equation
  T_s = G*(omega_ref - shaft.omega);
  shaft.T_s = T_s;
  connect(T_L, shaft.T_L);
  connect(omega_ref, shaft.direction);
  connect(shaft.theta, theta);
  connect(shaft.omega, omega);
  connect(shaft.omega_s, omega_s);
  annotation(Documentation(info="<html>
<p>T<sub>s</sub> = G (&omega;<sub>ref</sub> - &omega;). The friction of Table 6.2 falls with speed by up to
4.8 N m s/rad: a torque alone, or a drive softer than that, makes the shaft stick and slip.</p>
<p><b>Source:</b> this library, for the manual test of thesis Section 6.2, where the pump's flow held the speed.</p>
<p><b>Valid:</b> G well above the steepest fall of the friction.</p>
<p><b>Leaves out:</b> the hydraulics of the drive.</p>
</html>"));
end DrivenShaft;
