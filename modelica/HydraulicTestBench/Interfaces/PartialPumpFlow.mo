within HydraulicTestBench.Interfaces;
partial model PartialPumpFlow "Slot for the flow of a pump and the torque it takes"
  extends Icons.Slot;
  parameter Types.Volume V_d_max "Displacement per revolution at the largest angle";
  parameter Types.Angle alphaMAX "Largest swash plate angle";
  parameter Integer N_p = 9 "Number of pistons, those of the A4VSG";
  parameter Real eta_r(final unit="1") "Depth of the ripple's spikes over the mean flow";
  parameter Real psi(final unit="1") "Amplitude of the simplified ripple over the depth of the spikes";
  parameter Types.Angle theta_0 "Angle of piston 1 where that of the shaft is 0";
  RealInput alpha(unit="rad") "Swash plate angle"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  RealInput alpha_t(unit="rad/s") "Its rate"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  Flange_a shaft "Drive"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Port_b port_A "Outlet at positive speed and angle"
    annotation(Placement(transformation(extent={{90, 50}, {110, 70}})));
  Port_a port_B "Inlet at positive speed and angle"
    annotation(Placement(transformation(extent={{90, -70}, {110, -50}})));
  Types.Angle theta "Angular position of piston 1, Eq. 3.35";
  Types.AngularVelocity omega "Speed of the shaft";
  Types.VolumeFlowRate QBar "Mean flow, Eq. 3.48";
  Types.VolumeFlowRate QPA "Flow out of port A, Eq. 3.46";
  Types.VolumeFlowRate QPB "Flow out of port B, Eq. 3.47";
  Types.VolumeFlowRate DQPA "Ripple at port A, Eq. 3.49";
  Types.VolumeFlowRate DQPB "Ripple at port B, Eq. 3.50";
  Types.Torque tau "Torque that the oil takes from the shaft";
  Types.Frequency f_r "Ripple frequency, Eq. 3.54; a period has two strokes";
  Types.VolumeFlowRate A_r "Amplitude of the simplified ripple, Eq. 3.64";
  Types.VolumeFlowRate O_r "Offset of the simplified ripple, Eq. 3.57";
equation
  theta = shaft.phi + theta_0;
  omega = der(shaft.phi);
  QBar = omega/(2*Constants.pi)*alpha/alphaMAX*V_d_max;
  DQPA = QPA - QBar;
  DQPB = QPB + QBar;
  f_r = (if N_p == 2*div(N_p, 2) then 1 else 2)*N_p*abs(omega)/(4*Constants.pi);
  A_r = psi*eta_r*QBar;
  O_r = -2/Constants.pi*A_r;
  port_A.q = -QPA;
  port_B.q = -QPB;
  shaft.tau = tau;
  annotation(Documentation(info="<html>
<p>The law is three equations, for QPA, QPB and tau. So that no energy is made, tau has to be the work of the pistons
over the angle of the shaft. f_r, A_r and O_r are those of the simplified ripple, whether the law uses them or not.</p>
<p><b>Source:</b> thesis Eq. 3.35, 3.46 to 3.50, 3.54, 3.57, 3.64; names of Table 9. Eq. 3.22 prints the mean flow
without its 2&pi;.</p>
<p><b>Used by:</b> <code>pumpFlow</code> of <code>Pump.A4VSG</code>.</p>
</html>"));
end PartialPumpFlow;
