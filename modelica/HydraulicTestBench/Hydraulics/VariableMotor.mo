within HydraulicTestBench.Hydraulics;
model VariableMotor "Motor of variable displacement, thesis Eq. 5.7 to 5.9"
  extends Icons.Component;
  parameter Types.Volume V_max(min=1e-9) = 60e-6 "Displacement per revolution at the largest angle";
  parameter Types.Angle alphaMAX(min=0.01) = 35*Constants.pi/180 "Largest angle";
  Interfaces.Port_a port_A "Inlet at positive speed and angle"
    annotation(Placement(transformation(extent={{-110, 50}, {-90, 70}})));
  Interfaces.Port_b port_B "Outlet at positive speed and angle"
    annotation(Placement(transformation(extent={{-110, -70}, {-90, -50}})));
  Interfaces.Port_b port_D "Drain, to a tank"
    annotation(Placement(transformation(extent={{-10, -110}, {10, -90}})));
  Interfaces.Flange_b shaft "Shaft"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  Interfaces.RealInput alpha(unit="rad") "Angle of the bent axis or swash plate"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}}, rotation=-90, origin={0, 120})));
  replaceable Interfaces.Neutral.InternalLeakage portLeakage constrainedby Interfaces.PartialTwoPort
    "Leakage from A to B"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-52, -12}, {-28, 12}})));
  replaceable Interfaces.Neutral.ExternalLeakage drainLeakage constrainedby Interfaces.PartialExternalLeakage
    "Leakage from A and B to the drain"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-12, -62}, {12, -38}})));
  replaceable Interfaces.Neutral.TorqueLoss torqueLoss constrainedby Interfaces.PartialTorqueLoss
    "Torque lost between oil and shaft"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{48, -12}, {72, 12}})));
  IdealMotor motor(final V_max=V_max, final alphaMAX=alphaMAX) "Displacement without losses"
    annotation(Placement(transformation(extent={{-12, 38}, {12, 62}})));
  Types.AngularVelocity omega = motor.omega "Speed";
  Types.VolumeFlowRate Q = motor.Q "Flow through the ideal motor, Eq. 5.7";
  Types.Torque tau = motor.tau "Torque of the oil on the shaft, Eq. 5.8";
  Types.Pressure dp = port_A.p - port_B.p "Pressure difference, Eq. 5.3";
equation
  connect(alpha, motor.alpha);
  connect(port_A, motor.port_A);
  connect(port_B, motor.port_B);
  connect(motor.shaft, shaft);
  connect(port_A, portLeakage.port_a);
  connect(port_B, portLeakage.port_b);
  connect(port_A, drainLeakage.port_1);
  connect(port_B, drainLeakage.port_2);
  connect(drainLeakage.port_T, port_D);
  connect(torqueLoss.flange, shaft);
  torqueLoss.p_A = port_A.p;
  torqueLoss.p_B = port_B.p;
  annotation(Documentation(info="<html>
<p>An <code>IdealMotor</code> with places for its losses, which are off unless filled: <code>LaminarResistance</code> or
<code>Effects.LeakageLaminar</code> in <code>portLeakage</code>, <code>Effects.LeakageExternal</code> in
<code>drainLeakage</code>, <code>Mechanics.MachineLoss</code> in <code>torqueLoss</code>.</p>
<p><b>Source:</b> thesis Eq. 5.7 to 5.9 and 5.19 to 5.22; Appendix D.4, Table 3 (Parker V12-060).</p>
<p><b>Valid:</b> any speed, pressures and angle. The drain has to be connected.</p>
<p><b>Leaves out:</b> inertia (Table 3 gives 3.1e-3 kg m2: add an <code>Inertia</code>), ripple, and all losses as long
as the slots are neutral.</p>
</html>"));
end VariableMotor;
