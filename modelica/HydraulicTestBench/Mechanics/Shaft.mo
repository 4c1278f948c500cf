within HydraulicTestBench.Mechanics;
model Shaft "Shaft between supply and load motor, thesis Fig. 5.12"
  extends Icons.Component;
  parameter Types.MomentOfInertia J_eff(min=1e-3) = 0.0733 "Inertia of both motors and the shaft";
  parameter Real r(final unit="s/rad", min=0.1, max=1e3, nominal=10) = 13.8806 "Steepness of friction at standstill";
  parameter Types.AngularVelocity omega_0(min=0.1, max=100) = 8.3593 "Speed over which stiction fades";
  parameter Types.Torque tau_c(min=0, max=500) = 14.8939 "Coulomb friction";
  parameter Types.Torque tau_s(min=0, max=500) = 54.8258 "Stiction";
  parameter Integer pulses(min=1) = 10 "Pulses of the speed sensor per revolution";
  Interfaces.RealInput T_s(unit="N.m", start=0) "Torque of the supply motor, drives"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  Interfaces.RealInput T_L(unit="N.m", start=0) "Torque of the load motor, against positive speed"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealInput direction(start=1) "Its sign is taken for that of the measured speed"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  Interfaces.RealOutput theta(unit="rad") "Angle"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput omega(unit="rad/s") "Speed"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  Interfaces.RealOutput omega_s(unit="rad/s") "Speed as the pulses tell it"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
  TorqueSource supply "Supply motor"
    annotation(Placement(transformation(extent={{-70, 50}, {-50, 70}})));
  TorqueSource load "Load motor"
    annotation(Placement(transformation(extent={{70, 50}, {50, 70}})));
  Inertia inertia(final J=J_eff) "Motors and shaft"
    annotation(Placement(transformation(extent={{-10, 50}, {10, 70}})));
  Friction friction(final r=r, final omega_0=omega_0, final tau_c=tau_c, final tau_s=tau_s) "Friction"
    annotation(Placement(transformation(extent={{-10, 10}, {10, 30}})));
  PulseSensor sensor(final pulses=pulses) "Inductive sensor"
    annotation(Placement(transformation(extent={{50, -70}, {70, -50}})));
equation
  supply.tau = T_s;
  load.tau = -T_L;
  connect(supply.flange, inertia.flange_a);
  connect(load.flange, inertia.flange_b);
  connect(friction.flange, inertia.flange_b);
  connect(sensor.flange, inertia.flange_b);
  connect(direction, sensor.direction);
  theta = inertia.phi;
  omega = inertia.w;
  connect(sensor.w, omega_s);
  annotation(Documentation(info="<html>
<p>J<sub>eff</sub> d&omega;/dt = T<sub>s</sub> - T<sub>L</sub> - &tau;<sub>f</sub>(&omega;), with the speed as the pulse
sensor tells it beside the true one.</p>
<p><b>Source:</b> thesis Eq. 5.1, 5.38, 5.40; friction of Table 6.2, inertia of Table 5.1.</p>
<p><b>Valid:</b> torques of the motors as they come from their pressures, T = K p (Eq. 5.8).</p>
<p><b>Leaves out:</b> the motors' own losses, which count as friction; torsion of the coupling.</p>
</html>"));
end Shaft;
