within HydraulicTestBench.Examples;
model LoadedPlate "A pump whose load pulls at its swash plate, on an orifice"
  extends Icons.Example;
  Mechanics.ConstantSpeed drive(w=1450*2*Constants.pi/60) "Drive"
    annotation(Placement(transformation(extent={{-80, -10}, {-60, 10}})));
  Pump.A4VSGCoupled pump "Pump"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}})));
  Hydraulics.Volume volume(V=1e-3, beta=1.4e9, p_start=25e5) "Oil between pump and orifice"
    annotation(Placement(transformation(extent={{-40, 50}, {-20, 70}})));
  Hydraulics.Orifice orifice(K=1.18e-5, rho=875) "Load: 52 bar at 75 percent of the angle"
    annotation(Placement(transformation(extent={{-10, 50}, {10, 70}})));
  Hydraulics.Tank refill(p=25e5) "Refilled side"
    annotation(Placement(transformation(extent={{20, 50}, {40, 70}})));
  Types.Torque T = pump.pistonForce.T "Pull of the pistons on the swash plate";
equation
  pump.alphaCMD = 75 + 10*sin(2*Constants.pi*5*time);
  pump.alphaCMD_t = 10*2*Constants.pi*5*cos(2*Constants.pi*5*time);
  connect(drive.flange, pump.shaft);
  connect(pump.port_A, volume.port_a);
  connect(volume.port_b, orifice.port_a);
  connect(orifice.port_b, refill.port);
  connect(pump.port_B, refill.port);
  annotation(
    experiment(StartTime=0, StopTime=1, Interval=0.001, Tolerance=1e-6),
    Documentation(info="<html>
<p>Plot <code>T</code>: a few newton metres, as the pressure difference and the mean pressure pull against each other.
Set <code>pump.pistonForce.share</code> to 0 and nothing of the angle changes that one could see.</p>
<p><b>Source:</b> thesis Section 4.2.2 for the load; the orifice's size follows from Table 4.2 at 75 percent.</p>
</html>"));
end LoadedPlate;
