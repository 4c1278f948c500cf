within HydraulicTestBench.Examples;
model RippleRelief "Two pumps, with ripple and without, each on a relief valve tuned to the ripple"
  extends Icons.Example;
  parameter Types.Duration T_open = 1/435 "Undamped opening time of both valves: the ripple's period";
  parameter Types.Pressure p_set = 310e5 "Difference at which they begin to open";
  parameter Types.Pressure dp_open = 100e5 "Further difference that holds them fully open";
  parameter Types.Area K_max = 7.3e-6 "Opening area when fully open";
  parameter Types.DampingRatio zeta = 0.53 "Damping ratio of the poppets";
  Mechanics.ConstantSpeed drive(w=1450*2*Constants.pi/60) "Drive of both"
    annotation(Placement(transformation(extent={{-10, -10}, {10, 10}})));
  replaceable Pump.A4VSG rippling constrainedby Pump.A4VSG "Pump with simplified ripple"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-60, -20}, {-20, 20}})));
  Pump.A4VSG quiet(redeclare Pump.MeanFlow pumpFlow) "Pump without ripple"
    annotation(Placement(transformation(extent={{60, -20}, {20, 20}})));
  Hydraulics.Volume volume1(V=0.1e-3, beta=1.4e9) "Volume of the pump with ripple"
    annotation(Placement(transformation(extent={{-90, 40}, {-70, 60}})));
  Hydraulics.Volume volume2(V=0.1e-3, beta=1.4e9) "Volume of the pump without"
    annotation(Placement(transformation(extent={{90, 40}, {70, 60}})));
  Hydraulics.ReliefValve valve1(
    p_set=p_set, dp_open=dp_open, K_max=K_max, rho=875, T_open=T_open, zeta=zeta) "Valve of the pump with ripple"
    annotation(Placement(transformation(extent={{-60, 40}, {-40, 60}})));
  Hydraulics.ReliefValve valve2(
    p_set=p_set, dp_open=dp_open, K_max=K_max, rho=875, T_open=T_open, zeta=zeta) "Valve of the pump without"
    annotation(Placement(transformation(extent={{60, 40}, {40, 60}})));
  Hydraulics.Tank tank "Tank"
    annotation(Placement(transformation(extent={{-10, -70}, {10, -50}})));
equation
  rippling.alphaCMD = 50;
  rippling.alphaCMD_t = 0;
  quiet.alphaCMD = 50;
  quiet.alphaCMD_t = 0;
  connect(drive.flange, rippling.shaft);
  connect(drive.flange, quiet.shaft);
  connect(rippling.port_A, volume1.port_a);
  connect(volume1.port_b, valve1.port_a);
  connect(quiet.port_A, volume2.port_a);
  connect(volume2.port_b, valve2.port_a);
  connect(valve1.port_b, tank.port);
  connect(valve2.port_b, tank.port);
  connect(rippling.port_B, tank.port);
  connect(quiet.port_B, tank.port);
  connect(rippling.port_D, tank.port);
  connect(quiet.port_D, tank.port);
  annotation(
    experiment(StartTime=0, StopTime=0.6, Interval=0.0001, Tolerance=1e-7),
    Documentation(info="<html>
<p>Plot <code>valve1.opening</code> and <code>valve2.opening</code>. At rest both are open by some 41 percent at 350
bar; the ripple of one percent of the flow swings the first one by ten times as much.</p>
<p><b>Source:</b> thesis Section 4.5, Fig. 4.10 and 4.11: 50 percent of the angle, 0.1 dm3, an undamped opening time of
1/435 s; there the opening swings between 35 and 48 percent. The valve's other data were not published. Here its mean
opening is that of Fig. 4.11, its pressure the pump's nominal one (Table 1), and its damping the one at which volume and
valve respond most at 435 Hz, 2&zeta; dp_open &omega;V/&beta; = Q/opening: just above what keeps them from
swinging by themselves.</p>
</html>"));
end RippleRelief;
