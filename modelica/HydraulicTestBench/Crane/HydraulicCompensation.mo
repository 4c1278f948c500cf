within HydraulicTestBench.Crane;
model HydraulicCompensation "Crane whose winch is a motor in a closed circuit with the pump"
  extends Icons.Component;
  constant Data.Crane crane = Data.Crane() "Numbers of the crane";
  constant Data.LoadCircuit bench = Data.LoadCircuit() "Numbers of motor and lines";
  constant Data.StaticParameters oil = Data.StaticParameters() "Oil";
  constant Data.PumpGeometry geometry = Data.PumpGeometry() "Pump";
  parameter Types.Length r_d = crane.r_d "Radius of the drum";
  parameter Types.Mass m_PL = crane.m_PL "Mass of the payload";
  parameter Types.Volume V_PL = crane.V_PL "Volume of the payload";
  parameter Types.SpringConstant k_w = crane.E_w*crane.A_w/crane.L_w "Stiffness of the wire, Eq. 5.47";
  parameter Real c_share(final unit="s", min=0) = 0.1 "Damping of the wire over its stiffness, Eq. 5.48";
  parameter Types.MomentOfInertia J_eff(min=1e-4) = crane.J_d "Inertia of drum and motor";
  parameter Real c(final unit="N.m.s/rad", min=0) = crane.c_d "Rotational damping";
  parameter Types.Volume V_s0(min=1e-6) = bench.V_s0 "Dead volume on each side of the motor";
  parameter Types.Volume Vm_max(min=1e-9) = bench.Vm_max "Displacement of the motor per revolution";
  parameter Types.AngularVelocity w_P = 1450*2*Constants.pi/60 "Speed of the pump's drive";
  final parameter Types.Force W = (m_PL - crane.rho_s*V_PL)*crane.g "Weight in water";
  final parameter Types.Pressure p_W = W*r_d*2*Constants.pi/Vm_max "Pressure that holds the payload";
  Interfaces.RealInput alphaCMD(unit="%", min=-100, max=100, start=0, nominal=10) "Command of the pump's angle"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  Interfaces.RealInput alphaCMD_t(unit="%/s", start=0, nominal=100) "Rate of alphaCMD where known, else 0"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealInput z_v_t(unit="m/s", start=0, nominal=1) "Velocity of the vessel, upwards"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  Interfaces.RealOutput omega(unit="rad/s", nominal=10) "Speed of the drum"
    annotation(Placement(transformation(extent={{100, 70}, {120, 90}})));
  Interfaces.RealOutput pS(unit="Pa", nominal=1e6) "Pressure across the motor"
    annotation(Placement(transformation(extent={{100, 30}, {120, 50}})));
  Interfaces.RealOutput F_L(unit="N", nominal=1e3) "Tension of the wire, Eq. 5.49"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  Interfaces.RealOutput z_v(unit="m") "Heave of the vessel"
    annotation(Placement(transformation(extent={{100, -50}, {120, -30}})));
  Interfaces.RealOutput z_PL(unit="m") "Height of the payload"
    annotation(Placement(transformation(extent={{100, -90}, {120, -70}})));
  replaceable Pump.GreyBoxPlate plate(alphaMAX=oil.alphaMAX) constrainedby Interfaces.PartialSwashPlate(
    alphaMAX=oil.alphaMAX) "From the pump's command to its angle"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-90, 50}, {-70, 70}})));
  Pump.MeanFlow pumpFlow(
    final V_d_max=geometry.V_d_max, final alphaMAX=oil.alphaMAX, final N_p=geometry.N_p, final eta_r=geometry.eta_r,
    final psi=geometry.psi, final theta_0=0) "Flow of the pump"
    annotation(Placement(transformation(extent={{-60, 40}, {-40, 60}})));
  Mechanics.ConstantSpeed drive(final w=w_P) "Drive of the pump"
    annotation(Placement(transformation(extent={{-90, 16}, {-70, 36}})));
  Hydraulics.Volume volume_A(final V=V_s0, final beta=oil.beta, p_start=bench.p_refill + p_W) "Line A"
    annotation(Placement(transformation(extent={{-28, 76}, {-12, 92}})));
  Hydraulics.Volume volume_B(final V=V_s0, final beta=oil.beta, p_start=bench.p_refill) "Line B"
    annotation(Placement(transformation(extent={{-28, 16}, {-12, 32}})));
  Hydraulics.Tank refill(final p=bench.p_refill) "Refill"
    annotation(Placement(transformation(extent={{-28, 46}, {-12, 62}})));
  Hydraulics.CheckValve refill_A(K=2e-5, final rho=oil.rho, p_crack=0) "Refill of line A"
    annotation(Placement(transformation(extent={{-4, 58}, {12, 74}})));
  Hydraulics.CheckValve refill_B(K=2e-5, final rho=oil.rho, p_crack=0) "Refill of line B"
    annotation(Placement(transformation(extent={{-4, 34}, {12, 50}})));
  Hydraulics.IdealMotor motor(final V_max=Vm_max, final alphaMAX=bench.alpha_m) "Motor"
    annotation(Placement(transformation(extent={{20, 44}, {40, 64}})));
  Mechanics.Inertia inertia(final J=J_eff) "Drum and motor"
    annotation(Placement(transformation(extent={{50, 44}, {70, 64}})));
  VesselDrum drum(final r_d=r_d) "Drum"
    annotation(Placement(transformation(extent={{50, 0}, {70, 20}})));
  Mechanics.Wire wire(final k_w=k_w, final d_w=c_share*k_w) "Wire"
    annotation(Placement(transformation(origin={60, -30}, extent={{-10, -10}, {10, 10}}, rotation=-90)));
  Payload payload(
    final m_PL=m_PL, final V_PL=V_PL, final A_PL=crane.A_PL, final C_d=crane.C_d, final rho_s=crane.rho_s,
    final g=crane.g, z_start=-W/k_w) "Payload, hanging at rest at the start"
    annotation(Placement(transformation(extent={{50, -80}, {70, -60}})));
protected
  Mechanics.TorqueSource friction "Rotational damping"
    annotation(Placement(transformation(extent={{78, 66}, {94, 82}})));
equation
  connect(alphaCMD, plate.alphaCMD);
  connect(alphaCMD_t, plate.alphaCMD_t);
  connect(plate.alpha, pumpFlow.alpha);
  connect(plate.alpha_t, pumpFlow.alpha_t);
  connect(drive.flange, pumpFlow.shaft);
  connect(pumpFlow.port_A, volume_A.port_a);
  connect(pumpFlow.port_B, volume_B.port_a);
  connect(volume_A.port_b, motor.port_A);
  connect(volume_B.port_b, motor.port_B);
  connect(refill.port, refill_A.port_a);
  connect(refill.port, refill_B.port_a);
  connect(refill_A.port_b, volume_A.port_a);
  connect(refill_B.port_b, volume_B.port_a);
  motor.alpha = bench.alpha_m;
  connect(motor.shaft, inertia.flange_a);
  connect(inertia.flange_b, drum.shaft);
  connect(friction.flange, inertia.flange_b);
  friction.tau = -c*inertia.w;
  connect(z_v_t, drum.z_v_t);
  connect(drum.wire, wire.flange_a);
  connect(wire.flange_b, payload.flange);
  omega = inertia.w;
  pS = volume_A.p - volume_B.p;
  F_L = wire.F_w;
  z_v = drum.z_v;
  z_PL = payload.z_PL;
  annotation(Documentation(info="<html>
<p>J<sub>eff</sub> d&omega;/dt = T<sub>s</sub> - r F<sub>L</sub> - c&omega;: the pump's flow turns the motor, the motor
the drum. The start is at rest: the payload hangs on its wire, and the oil holds it.</p>
<p><b>Source:</b> thesis Section 5.7, Eq. 5.43 to 5.49, with the closed circuit of Section 5.3; numbers chosen, see
<code>Data.Crane</code>.</p>
<p><b>Valid:</b> wire taut or slack.</p>
<p><b>Leaves out:</b> leakage (the payload does not creep), Coulomb friction, safety valves.</p>
</html>"));
end HydraulicCompensation;
