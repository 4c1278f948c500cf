within HydraulicTestBench.Validation;
model PumpFlow "Three descriptions of a pump's flow on one shaft, at a fixed angle"
  extends Icons.Example;
  parameter Types.Angle alpha = 15*Constants.pi/180 "Swash plate angle";
  parameter Integer N_p = 9 "Number of pistons";
  constant Data.PumpGeometry known = Data.PumpGeometry() "Known geometry";
  Mechanics.ConstantSpeed drive(w=1450*2*Constants.pi/60) "Drive"
    annotation(Placement(transformation(extent={{-80, -10}, {-60, 10}})));
  Pump.MeanFlow mean(
    V_d_max=known.V_d_max, alphaMAX=15*Constants.pi/180, N_p=N_p, eta_r=known.eta_r, psi=known.psi, theta_0=0)
    "Without ripple"
    annotation(Placement(transformation(extent={{-20, 50}, {20, 90}})));
  Pump.SimplifiedRippleFlow simplified(
    V_d_max=known.V_d_max, alphaMAX=15*Constants.pi/180, N_p=N_p, eta_r=known.eta_r, psi=known.psi, theta_0=0)
    "With simplified ripple"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}})));
  Pump.PistonKinematicsFlow kinematic(
    V_d_max=known.V_d_max, alphaMAX=15*Constants.pi/180, N_p=N_p, eta_r=known.eta_r, psi=known.psi, theta_0=0)
    "With all pistons"
    annotation(Placement(transformation(extent={{-20, -90}, {20, -50}})));
  Hydraulics.Tank port_A(p=200e5) "Pressure at the outlets"
    annotation(Placement(transformation(extent={{60, 40}, {80, 60}})));
  Hydraulics.Tank port_B(p=25e5) "Pressure at the inlets"
    annotation(Placement(transformation(extent={{60, -60}, {80, -40}})));
  Types.Power error_mean = mean.tau*mean.omega + mean.port_A.p*mean.port_A.q + mean.port_B.p*mean.port_B.q
    "Power of the shaft less that of the oil";
  Types.Power error_simplified = simplified.tau*simplified.omega + simplified.port_A.p*simplified.port_A.q
    + simplified.port_B.p*simplified.port_B.q "Power of the shaft less that of the oil";
  Types.Power error_kinematic = kinematic.tau*kinematic.omega + kinematic.port_A.p*kinematic.port_A.q
    + kinematic.port_B.p*kinematic.port_B.q "Power of the shaft less that of the oil";
  Types.Length r_0 = kinematic.r_0 "Eq. 3.34: 44.44 mm";
equation
  mean.alpha = alpha;
  simplified.alpha = alpha;
  kinematic.alpha = alpha;
  mean.alpha_t = 0;
  simplified.alpha_t = 0;
  kinematic.alpha_t = 0;
  connect(drive.flange, mean.shaft);
  connect(drive.flange, simplified.shaft);
  connect(drive.flange, kinematic.shaft);
  connect(mean.port_A, port_A.port);
  connect(simplified.port_A, port_A.port);
  connect(kinematic.port_A, port_A.port);
  connect(mean.port_B, port_B.port);
  connect(simplified.port_B, port_B.port);
  connect(kinematic.port_B, port_B.port);
  annotation(
    experiment(StartTime=0, StopTime=0.0413793103448276, Interval=0.00001, Tolerance=1e-8),
    Documentation(info="<html>
<p>One revolution at 1450 rpm and 15 degrees: thesis Fig. 3.9 and 3.11. The mean is 102.95 l/min; the pistons' flow
reaches 0.6392 l/min above it and 2.037 l/min below. Other numbers of pistons: 0.349 above with 13, 1.006 with 7, 2.937
with 8, 1.891 with 10. Power goes in at the shaft and comes out at the ports without loss.</p>
<p><b>Source:</b> thesis Eq. 3.23 to 3.66. Fig. 3.10 and Eq. 3.52 (2.063 l/min) differ a little from the equations'
own result.</p>
</html>"));
end PumpFlow;
