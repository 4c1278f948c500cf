within HydraulicTestBench.Mechanics;
model SpeedSensor "Ideal sensor of angle and speed"
  extends Icons.Component;
  Interfaces.Flange_a flange "Shaft"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.RealOutput phi(unit="rad") "Angle"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput w(unit="rad/s") "Speed"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
equation
  flange.tau = 0;
  phi = flange.phi;
  w = der(flange.phi);
  annotation(Documentation(info="<html>
<p>Reads angle and speed without load on the shaft.</p>
<p><b>Source:</b> thesis Table 14, <code>theta</code> and <code>contOmega</code>.</p>
<p><b>Leaves out:</b> what a real sensor does; the thesis' is <code>PulseSensor</code>.</p>
</html>"));
end SpeedSensor;
