within HydraulicTestBench.Validation;
model PassiveParts "Resistive parts between two swinging pressures: none gives energy"
  extends Icons.Example;
  Hydraulics.PrescribedPressure left "Pressure on the left"
    annotation(Placement(transformation(extent={{-80, -10}, {-60, 10}})));
  Hydraulics.PrescribedPressure right "Pressure on the right"
    annotation(Placement(transformation(extent={{80, -10}, {60, 10}})));
  Hydraulics.Orifice orifice(K=1e-6, rho=875) "Orifice"
    annotation(Placement(transformation(extent={{-10, 60}, {10, 80}})));
  Hydraulics.LaminarResistance resistance(G=1e-12) "Resistance"
    annotation(Placement(transformation(extent={{-10, 30}, {10, 50}})));
  Hydraulics.CheckValve check(K=1e-6, rho=875, p_crack=2e5, dp_open=3e5) "Check valve"
    annotation(Placement(transformation(extent={{-10, 0}, {10, 20}})));
  Hydraulics.ReliefValve relief(p_set=20e5, dp_open=10e5, K_max=1e-6, rho=875, T_open=5e-3, zeta=0.3) "Relief valve"
    annotation(Placement(transformation(extent={{-10, -30}, {10, -10}})));
  Hydraulics.ServoValve servo(K_sv=1e-6, rho=875) "Servo valve"
    annotation(Placement(transformation(extent={{-10, -60}, {10, -40}})));
  Types.Power P_orifice = orifice.dp*orifice.q "Power lost in the orifice";
  Types.Power P_resistance = resistance.dp*resistance.q "Power lost in the resistance";
  Types.Power P_check = check.dp*check.q "Power lost in the check valve";
  Types.Power P_relief = relief.dp*relief.q "Power lost in the relief valve";
  Types.Power P_servo = servo.port_P.p*servo.port_P.q + servo.port_T.p*servo.port_T.q
    + servo.port_A.p*servo.port_A.q + servo.port_B.p*servo.port_B.q "Power lost in the servo valve";
  Types.Power error = min(min(min(min(P_orifice, P_resistance), P_check), P_relief), min(P_servo, 0))
    "Power that a part would give, 0 if none";
equation
  left.p = 20e5 + 40e5*sin(17*time);
  right.p = 10e5 + 30e5*sin(29*time + 1);
  servo.u_ref = 0.9*sin(11*time);
  connect(left.port, orifice.port_a);
  connect(left.port, resistance.port_a);
  connect(left.port, check.port_a);
  connect(left.port, relief.port_a);
  connect(left.port, servo.port_P);
  connect(left.port, servo.port_B);
  connect(right.port, orifice.port_b);
  connect(right.port, resistance.port_b);
  connect(right.port, check.port_b);
  connect(right.port, relief.port_b);
  connect(right.port, servo.port_T);
  connect(right.port, servo.port_A);
  annotation(
    experiment(StartTime=0, StopTime=2, Interval=0.001, Tolerance=1e-8),
    Documentation(info="<html>
<p>Pressures that change their order many times; the power each part takes is never negative.</p>
<p><b>Source:</b> second law of thermodynamics.</p>
</html>"));
end PassiveParts;
