within HydraulicTestBench.Validation;
model MotorRunUp "Motor with losses that accelerates a mass under constant pressure"
  extends Icons.Example;
  Hydraulics.Tank high(p=100e5) "High pressure"
    annotation(Placement(transformation(extent={{-80, 40}, {-60, 60}})));
  Hydraulics.Tank low(p=25e5) "Low pressure"
    annotation(Placement(transformation(extent={{-80, -40}, {-60, -20}})));
  Hydraulics.Tank tank "Drain"
    annotation(Placement(transformation(extent={{-20, -80}, {0, -60}})));
  Hydraulics.VariableMotor motor(
    redeclare Hydraulics.LaminarResistance portLeakage(G=1e-12),
    redeclare Effects.LeakageExternal drainLeakage(C_e=2e-12),
    redeclare Mechanics.MachineLoss torqueLoss(c=0.5)) "Motor at half its angle"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}})));
  Mechanics.TorqueSensor torqueSensor "Torque sensor"
    annotation(Placement(transformation(extent={{30, -10}, {50, 10}})));
  Mechanics.Inertia inertia(J=0.1) "Mass"
    annotation(Placement(transformation(extent={{60, -10}, {80, 10}})));
  Mechanics.SpeedSensor speedSensor "Speed sensor"
    annotation(Placement(transformation(extent={{60, -60}, {80, -40}})));
  Hydraulics.FlowSensor meter "Flow into port A"
    annotation(Placement(transformation(extent={{-50, 40}, {-30, 60}})));
  Types.AngularVelocity w_exact = tau_0/0.5*(1 - exp(-0.5*time/0.1)) "Closed form";
  Types.AngularVelocity error = speedSensor.w - w_exact "Difference from the closed form";
  Types.VolumeFlowRate error_Q = meter.Q - (30e-6/(2*Constants.pi)*w_exact + 75e5*1e-12 + 100e5*2e-12)
    "Flow, difference from the closed form";
  Types.Torque error_tau = torqueSensor.tau - (tau_0 - 0.5*w_exact) "Torque, difference from the closed form";
  Types.Power lost = high.p*meter.Q - low.p*low.port.q - torqueSensor.tau*speedSensor.w "Power that stays in the motor";
protected
  final parameter Types.Torque tau_0 = 30e-6/(2*Constants.pi)*75e5 "Torque of the ideal motor";
equation
  connect(high.port, meter.port_a);
  connect(meter.port_b, motor.port_A);
  connect(low.port, motor.port_B);
  connect(tank.port, motor.port_D);
  connect(motor.shaft, torqueSensor.flange_a);
  connect(torqueSensor.flange_b, inertia.flange_a);
  connect(speedSensor.flange, inertia.flange_b);
  motor.alpha = 17.5*Constants.pi/180;
  annotation(
    experiment(StartTime=0, StopTime=1, Interval=0.01, Tolerance=1e-8),
    Documentation(info="<html>
<p>The speed rises as an exponential to the torque over the viscous loss; the flow is that of the displacement and two
leaks. <code>lost</code> is never negative: a motor with losses makes no power.</p>
<p><b>Source:</b> thesis Eq. 5.7 to 5.9, 5.40, solved by hand.</p>
</html>"));
end MotorRunUp;
