within HydraulicTestBench.Pump;
model A4VSGCoupled "The A4VSG pump whose load pulls at its swash plate; without losses"
  extends SwashPlateControl(stroke_share=0.95, redeclare PistonPull pistonForce(final a=a, final alphaMAX=alphaMAX));
  constant Data.PumpGeometry geometry = Data.PumpGeometry() "Known geometry";
  parameter Types.Volume V_d_max(min=1e-9) = geometry.V_d_max "Displacement per revolution at the largest angle"
    annotation(Dialog(group="Flow"));
  Interfaces.Flange_a shaft "Drive"
    annotation(Placement(transformation(extent={{-210, -110}, {-190, -90}}),
      iconTransformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.Port_b port_A "Outlet at positive speed and angle"
    annotation(Placement(transformation(extent={{250, -10}, {270, 10}}),
      iconTransformation(extent={{-60, 90}, {-40, 110}})));
  Interfaces.Port_a port_B "Inlet at positive speed and angle"
    annotation(Placement(transformation(extent={{250, -50}, {270, -30}}),
      iconTransformation(extent={{40, 90}, {60, 110}})));
  MeanFlow pumpFlow(
    V_d_max=V_d_max, alphaMAX=alphaMAX, N_p=geometry.N_p, eta_r=geometry.eta_r, psi=geometry.psi, theta_0=0) "Flow"
    annotation(Placement(transformation(extent={{168, -32}, {192, -8}})));
equation
  pumpFlow.alpha = alpha;
  pumpFlow.alpha_t = alpha_t;
  connect(shaft, pumpFlow.shaft);
  connect(pumpFlow.port_A, port_A);
  connect(pumpFlow.port_B, port_B);
  pistonForce.alpha = alpha;
  pistonForce.p_A = port_A.p;
  pistonForce.p_B = port_B.p;
  annotation(Documentation(info="<html>
<p><code>PistonPull</code> stands in the slot of the control piston, so the pressures at the ports act on the angle.
The thesis saw no such effect (Section 4.2.3); the case <code>plate-pull</code> says how large it should be.</p>
<p><b>Source:</b> see <code>PistonPull</code> and <code>A4VSG</code>.</p>
<p><b>Valid:</b> where both are.</p>
<p><b>Leaves out:</b> ripple, leakage, drain and losses, which <code>A4VSG</code> has slots for.</p>
</html>"));
end A4VSGCoupled;
