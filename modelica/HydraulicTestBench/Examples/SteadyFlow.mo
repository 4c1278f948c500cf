within HydraulicTestBench.Examples;
model SteadyFlow "Flow over the command, slowly from stop to stop"
  extends Icons.Example;
  Mechanics.ConstantSpeed drive(w=1450*2*Constants.pi/60) "Drive"
    annotation(Placement(transformation(extent={{-80, -10}, {-60, 10}})));
  Pump.A4VSG pump(redeclare Pump.MeanFlow pumpFlow) "Pump"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}})));
  Hydraulics.Tank load "No load at port A"
    annotation(Placement(transformation(extent={{-30, 50}, {-10, 70}})));
  Hydraulics.Tank inlet "Port B"
    annotation(Placement(transformation(extent={{10, 50}, {30, 70}})));
  Hydraulics.Tank tank "Drain"
    annotation(Placement(transformation(extent={{-10, -70}, {10, -50}})));
  Types.VolumeFlowRate Q_theory = pump.alphaCMD/100*1450/60*71e-6 "Theoretical flow of thesis Fig. 4.1";
equation
  pump.alphaCMD = 100*sin(2*Constants.pi*time/100);
  pump.alphaCMD_t = 2*Constants.pi*cos(2*Constants.pi*time/100);
  connect(drive.flange, pump.shaft);
  connect(pump.port_A, load.port);
  connect(pump.port_B, inlet.port);
  connect(pump.port_D, tank.port);
  annotation(
    experiment(StartTime=0, StopTime=100, Interval=0.05, Tolerance=1e-6),
    Documentation(info="<html>
<p>Plot <code>pump.QActual</code> and <code>Q_theory</code> over <code>pump.alphaCMD</code>: one straight line that ends
at 95 percent of the angle, where the piston meets its stop.</p>
<p><b>Source:</b> thesis Section 4.1, Fig. 4.1, number 3. Its numbers 1 and 2 (ranges of the flow meters, a drive
somewhat faster than 1450 rpm) are not the pump's.</p>
</html>"));
end SteadyFlow;
