within HydraulicTestBench.Crane;
model IdealCompensation "Drum that follows the vessel exactly: references for the test bench"
  extends Icons.Component;
  constant Data.Crane crane = Data.Crane() "Numbers of the crane";
  parameter Types.Length r_d = crane.r_d "Radius of the drum";
  parameter Types.Mass m_PL = crane.m_PL "Mass of the payload";
  parameter Types.Volume V_PL = crane.V_PL "Volume of the payload";
  parameter Types.SpringConstant k_w = crane.E_w*crane.A_w/crane.L_w "Stiffness of the wire, Eq. 5.47";
  parameter Real c_share(final unit="s", min=0) = 0.1 "Damping of the wire over its stiffness, Eq. 5.48";
  parameter Types.Volume Vm_max = 60e-6 "Displacement of the test bench's load motor per revolution";
  parameter Real gain(final unit="1", min=0, max=2) = 1 "1 compensates all, 0 nothing";
  Interfaces.RealInput z_v_t(unit="m/s", start=0, nominal=1) "Velocity of the vessel, upwards"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealOutput omegaS_ref(unit="rad/s", nominal=10) "Reference of the speed, Eq. 5.50"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput pL_ref(unit="Pa", nominal=1e6) "Reference of the load pressure, Eq. 5.51"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  Interfaces.RealOutput z_PL(unit="m") "Height of the payload"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
  final parameter Types.Force W = (m_PL - crane.rho_s*V_PL)*crane.g "Weight in water";
  Mechanics.PrescribedSpeed winch "Winch"
    annotation(Placement(transformation(extent={{-60, -10}, {-40, 10}})));
  VesselDrum drum(final r_d=r_d) "Drum"
    annotation(Placement(transformation(extent={{-20, -10}, {0, 10}})));
  Mechanics.Wire wire(final k_w=k_w, final d_w=c_share*k_w) "Wire"
    annotation(Placement(transformation(extent={{20, -10}, {40, 10}})));
  Payload payload(
    final m_PL=m_PL, final V_PL=V_PL, final A_PL=crane.A_PL, final C_d=crane.C_d, final rho_s=crane.rho_s,
    final g=crane.g, z_start=-W/k_w) "Payload, hanging at rest at the start"
    annotation(Placement(transformation(extent={{60, -10}, {80, 10}})));
equation
  omegaS_ref = -gain*z_v_t/r_d;
  connect(z_v_t, drum.z_v_t);
  connect(omegaS_ref, winch.w);
  connect(winch.flange, drum.shaft);
  connect(drum.wire, wire.flange_a);
  connect(wire.flange_b, payload.flange);
  pL_ref = r_d*wire.F_w/(Vm_max/(2*Constants.pi));
  z_PL = payload.z_PL;
  annotation(Documentation(info="<html>
<p>&omega;<sub>ref</sub> = -(dz<sub>v</sub>/dt)/r, and the load pressure that puts the torque of the wire on the bench's
load motor. With full compensation the payload stands still and that pressure is constant.</p>
<p><b>Source:</b> thesis Eq. 5.47 to 5.51; numbers chosen, see <code>Data.Crane</code>.</p>
<p><b>Valid:</b> wire taut or slack. The wire's smooth beginning lets the payload hang 1.2 nm lower at rest than
W/k<sub>w</sub>.</p>
<p><b>Leaves out:</b> the winch's own dynamics: that is <code>HydraulicCompensation</code>.</p>
</html>"));
end IdealCompensation;
