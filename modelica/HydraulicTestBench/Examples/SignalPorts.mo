within HydraulicTestBench.Examples;
model SignalPorts "A circuit joined to the pump by its ports, beside the same one joined by signals"
  extends Icons.Example;
  parameter Types.AngularVelocity w_P = 1450*2*Constants.pi/60 "Speed of the drive";
  Mechanics.ConstantSpeed drive(w=w_P) "Drive"
    annotation(Placement(transformation(extent={{-100, 40}, {-80, 60}})));
  Pump.A4VSG pump "Pump with its ports"
    annotation(Placement(transformation(extent={{-60, 30}, {-20, 70}})));
  Hydraulics.Volume volume(V=2e-3, beta=1.4e9) "Line"
    annotation(Placement(transformation(extent={{0, 60}, {20, 80}})));
  Hydraulics.Orifice load(K=5e-6, rho=875) "Load"
    annotation(Placement(transformation(extent={{40, 60}, {60, 80}})));
  Hydraulics.Tank tank "Behind the load, at port B and at the drain"
    annotation(Placement(transformation(extent={{70, 30}, {90, 50}})));
  Pump.A4VSGSignals signals "What becomes an FMU: pressures and speed in, flows and torque out"
    annotation(Placement(transformation(extent={{-60, -70}, {-20, -30}})));
  Hydraulics.PrescribedFlow inflow "Takes the flow that the block gives"
    annotation(Placement(transformation(extent={{-10, -60}, {10, -40}})));
  Hydraulics.Volume joined(V=2e-3, beta=1.4e9) "Line of the other program"
    annotation(Placement(transformation(extent={{20, -60}, {40, -40}})));
  Hydraulics.PressureSensor sensor "Gives the pressure that the block wants"
    annotation(Placement(transformation(extent={{20, -90}, {40, -70}})));
  Hydraulics.Orifice joinedLoad(K=5e-6, rho=875) "Load of the other program"
    annotation(Placement(transformation(extent={{50, -60}, {70, -40}})));
  Hydraulics.Tank joinedTank "Behind that load"
    annotation(Placement(transformation(extent={{80, -80}, {100, -60}})));
  Types.Pressure error = joined.p - volume.p "Difference between both";
equation
  pump.alphaCMD = 40*(1 - cos(2*Constants.pi*time))/2;
  pump.alphaCMD_t = 40*Constants.pi*sin(2*Constants.pi*time);
  connect(drive.flange, pump.shaft);
  connect(pump.port_A, volume.port_a);
  connect(volume.port_b, load.port_a);
  connect(load.port_b, tank.port);
  connect(pump.port_B, tank.port);
  connect(pump.port_D, tank.port);
  signals.alphaCMD = pump.alphaCMD;
  signals.alphaCMD_t = pump.alphaCMD_t;
  signals.omega = w_P;
  connect(signals.Q_A, inflow.Q);
  connect(sensor.p, signals.p_A);
  signals.p_B = 0;
  connect(inflow.port, joined.port_a);
  connect(sensor.port, joined.port_a);
  connect(joined.port_b, joinedLoad.port_a);
  connect(joinedLoad.port_b, joinedTank.port);
  annotation(
    experiment(StartTime=0, StopTime=1, Interval=0.0001, Tolerance=1e-8),
    Documentation(info="<html>
<p>Plot <code>volume.p</code> and <code>joined.p</code>: they are the same. <code>PrescribedFlow</code>,
<code>Volume</code> and <code>PressureSensor</code> stand for what another program puts around the FMU of
<code>Pump.A4VSGSignals</code>: a volume that takes the flow and gives the pressure. So no equation goes round through
the signals: the pressure is a state.</p>
<p><b>Source:</b> this library; oil of <code>Data.StaticParameters</code>.</p>
</html>"));
end SignalPorts;
