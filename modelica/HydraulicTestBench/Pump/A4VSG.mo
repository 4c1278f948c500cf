within HydraulicTestBench.Pump;
model A4VSG "Bosch Rexroth A4VSG 71 pump as one block: shaft, ports A and B, drain, command"
  extends SwashPlateControl(stroke_share=0.95);
  constant Data.PumpGeometry geometry = Data.PumpGeometry() "Known geometry";
  parameter Types.Volume V_d_max(min=1e-9) = geometry.V_d_max "Displacement per revolution at the largest angle"
    annotation(Dialog(group="Flow"));
  parameter Integer N_p(min=1) = geometry.N_p "Number of pistons" annotation(Dialog(group="Flow"));
  parameter Real eta_r(final unit="1", min=0, max=1) = geometry.eta_r "Depth of the ripple's spikes over the mean flow"
    annotation(Dialog(group="Flow"));
  parameter Types.Angle theta_0 = 0 "Angle of piston 1 where that of the shaft is 0" annotation(Dialog(group="Flow"));
  parameter Real psi(final unit="1", min=0, max=2) = geometry.psi "Ratio of actual ripple used"
    annotation(Dialog(group="Known"));
  Interfaces.Flange_a shaft "Drive"
    annotation(Placement(transformation(extent={{-210, -110}, {-190, -90}}),
      iconTransformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.Port_b port_A "Outlet at positive speed and angle"
    annotation(Placement(transformation(extent={{250, -10}, {270, 10}}),
      iconTransformation(extent={{-60, 90}, {-40, 110}})));
  Interfaces.Port_a port_B "Inlet at positive speed and angle"
    annotation(Placement(transformation(extent={{250, -50}, {270, -30}}),
      iconTransformation(extent={{40, 90}, {60, 110}})));
  Interfaces.Port_b port_D "Drain, to a tank"
    annotation(Placement(transformation(extent={{250, -170}, {270, -150}}),
      iconTransformation(extent={{-10, -110}, {10, -90}})));
  replaceable SimplifiedRippleFlow pumpFlow(
    V_d_max=V_d_max, alphaMAX=alphaMAX, N_p=N_p, eta_r=eta_r, psi=psi, theta_0=theta_0)
    constrainedby Interfaces.PartialPumpFlow(
    V_d_max=V_d_max, alphaMAX=alphaMAX, N_p=N_p, eta_r=eta_r, psi=psi, theta_0=theta_0) "Flow and torque"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{168, -32}, {192, -8}})));
  replaceable Interfaces.Neutral.InternalLeakage portLeakage constrainedby Interfaces.PartialTwoPort
    "Leakage from A to B"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{208, -32}, {232, -8}})));
  replaceable Interfaces.Neutral.ExternalLeakage drainLeakage constrainedby Interfaces.PartialExternalLeakage
    "Leakage from A and B to the drain"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{208, -152}, {232, -128}})));
  replaceable Interfaces.Neutral.TorqueLoss torqueLoss constrainedby Interfaces.PartialTorqueLoss
    "Torque lost between shaft and oil"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-172, -112}, {-148, -88}})));

  // Names of thesis Tables 9 and 10
  Types.VolumeFlowRate QBar = pumpFlow.QBar "Mean flow, Eq. 3.48";
  Types.VolumeFlowRate DQPA = pumpFlow.DQPA "Ripple flow, Eq. 3.53 or 3.49";
  Types.VolumeFlowRate QActual = pumpFlow.QPA "Flow out of port A, with or without ripple, before leakage";
  Types.Frequency f_r = pumpFlow.f_r "Ripple frequency, Eq. 3.54";
  Types.VolumeFlowRate A_r = pumpFlow.A_r "Ripple amplitude, Eq. 3.64";
  Types.VolumeFlowRate O_r = pumpFlow.O_r "Ripple offset, Eq. 3.57";
equation
  pumpFlow.alpha = alpha;
  pumpFlow.alpha_t = alpha_t;
  connect(shaft, pumpFlow.shaft);
  connect(pumpFlow.port_A, port_A);
  connect(pumpFlow.port_B, port_B);
  connect(portLeakage.port_a, port_A);
  connect(portLeakage.port_b, port_B);
  connect(drainLeakage.port_1, port_A);
  connect(drainLeakage.port_2, port_B);
  connect(drainLeakage.port_T, port_D);
  connect(torqueLoss.flange, shaft);
  torqueLoss.p_A = port_A.p;
  torqueLoss.p_B = port_B.p;
  annotation(Documentation(info="<html>
<p>The pump to put into a model of one's own: its shaft to a drive, ports A and B to volumes, hoses or a tank, the drain
to a tank, the command in percent. Inside is <code>SwashPlateControl</code> with all its slots; the free parameter set
of Table 4.6 stands as default.</p>
<p><b>Flow.</b> The slot <code>pumpFlow</code> takes <code>MeanFlow</code> (fast, for circuits with hoses),
<code>SimplifiedRippleFlow</code> (default, as in the thesis) or <code>PistonKinematicsFlow</code> (each piston, with
events). The torque on the shaft follows from the pressures at the ports.</p>
<p><b>Losses.</b> Off unless filled: <code>portLeakage</code> (<code>Hydraulics.LaminarResistance</code>),
<code>drainLeakage</code> (<code>Effects.LeakageExternal</code>), <code>torqueLoss</code>
(<code>Mechanics.MachineLoss</code>).</p>
<p><b>The 18 parameters for users:</b> omega_v, zeta_v, L, A_p, V_0, m_eff, k, b, K_p, K_D, T_d, K_L, tau of the swash
plate control (thesis Table 4.6), and V_d_max, N_p, eta_r, theta_0, stroke_share. Appendix F counts 18 and its picture
shows ten; these 18 are this library's choice: all that was identified, and what the flow of a pump of another size
needs. What Table 6 calls static (beta, alphaMAX, rho, pS, pT, psi, k1, k2, k3; a, xpMAX and xpMIN follow from others)
can be changed too, but should not. N_p is fixed when an FMU with <code>PistonKinematicsFlow</code> is built.</p>
<p><b>Stop.</b> With stroke_share = 0.95 the angle ends at 95.2 percent, where the measured flow stops growing
(thesis Section 4.1, Fig. 4.1). Set it to 1 for the whole stroke, as in <code>FreeGreyBox</code>.</p>
<p><b>Source:</b> thesis Sections 3.4 and 3.5, Appendix F; names of Tables 6 to 10. <code>pumpFlow</code> is there the
name of a flow source with two ports, as it is here.</p>
<p><b>Valid:</b> as <code>SwashPlateControl</code> and the flow chosen. Ports A and B give flow from pressure, so each
wants a volume, a hose or a tank.</p>
<p><b>Leaves out:</b> the pull of the pistons on the swash plate (Section 4.2.3 found no effect of load); the boost pump
and flushing of the closed circuit, which belong to the circuit; the control oil, which has a supply of its own.</p>
</html>"));
end A4VSG;
