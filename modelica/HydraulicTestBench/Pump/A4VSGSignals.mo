within HydraulicTestBench.Pump;
model A4VSGSignals "The pump block with signals for its connectors: what to compile to an FMU"
  extends Icons.Component;
  Interfaces.RealInput alphaCMD(unit="%", min=-100, max=100, start=0, nominal=10) "Swash plate angle command"
    annotation(Placement(transformation(extent={{-140, 70}, {-100, 110}})));
  Interfaces.RealInput alphaCMD_t(unit="%/s", start=0, nominal=100) "Rate of alphaCMD where known, else 0"
    annotation(Placement(transformation(extent={{-140, 30}, {-100, 70}})));
  Interfaces.RealInput omega(unit="rad/s", start=151.8436, nominal=100) "Speed of the shaft"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealInput p_A(unit="Pa", start=0, nominal=1e7) "Pressure at port A"
    annotation(Placement(transformation(extent={{-140, -70}, {-100, -30}})));
  Interfaces.RealInput p_B(unit="Pa", start=0, nominal=1e7) "Pressure at port B"
    annotation(Placement(transformation(extent={{-140, -110}, {-100, -70}})));
  Interfaces.RealOutput alphaPercent(unit="%", nominal=10) "Swash plate angle as fed back and logged"
    annotation(Placement(transformation(extent={{100, 70}, {120, 90}})));
  Interfaces.RealOutput Q_A(unit="m3/s", nominal=1e-3) "Flow out of port A"
    annotation(Placement(transformation(extent={{100, 30}, {120, 50}})));
  Interfaces.RealOutput Q_B(unit="m3/s", nominal=1e-3) "Flow out of port B"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  Interfaces.RealOutput Q_D(unit="m3/s", nominal=1e-6) "Flow out of the drain"
    annotation(Placement(transformation(extent={{100, -50}, {120, -30}})));
  Interfaces.RealOutput tau(unit="N.m", nominal=100) "Torque the drive has to deliver"
    annotation(Placement(transformation(extent={{100, -90}, {120, -70}})));
  replaceable A4VSG pump constrainedby A4VSG "Pump"
    annotation(choicesAllMatching=true, Placement(transformation(extent={{-20, -20}, {20, 20}})));
  Mechanics.PrescribedSpeed drive "Shaft"
    annotation(Placement(transformation(extent={{-70, -10}, {-50, 10}})));
  Hydraulics.PrescribedPressure outlet "Port A"
    annotation(Placement(transformation(extent={{-70, -50}, {-50, -30}})));
  Hydraulics.PrescribedPressure inlet "Port B"
    annotation(Placement(transformation(extent={{-70, -90}, {-50, -70}})));
  Hydraulics.Tank tank "Drain"
    annotation(Placement(transformation(extent={{40, -60}, {60, -40}})));
equation
  connect(alphaCMD, pump.alphaCMD);
  connect(alphaCMD_t, pump.alphaCMD_t);
  connect(omega, drive.w);
  connect(p_A, outlet.p);
  connect(p_B, inlet.p);
  connect(drive.flange, pump.shaft);
  connect(outlet.port, pump.port_A);
  connect(inlet.port, pump.port_B);
  connect(tank.port, pump.port_D);
  connect(pump.alphaPercent, alphaPercent);
  Q_A = outlet.port.q;
  Q_B = inlet.port.q;
  Q_D = tank.port.q;
  tau = drive.tau;
  annotation(Documentation(info="<html>
<p>An FMU has no connectors, so each becomes a pair of signals: pressure in and flow out at a port, speed in and torque
out at the shaft. The program that imports it joins a port to a volume or a hose of its own, which gives the pressure
and
takes the flow; a drive of its own gives the speed and takes the torque. Speed starts at 1450 rpm.</p>
<p>For another flow or a loss, write a class of the pump and use it here:
<code>model MyPump extends A4VSG(redeclare MeanFlow pumpFlow); end MyPump;</code> and
<code>extends A4VSGSignals(redeclare MyPump pump)</code>.</p>
<p><b>Source:</b> thesis Appendix F for the block's interface.</p>
<p><b>Valid, leaves out:</b> see <code>A4VSG</code>. The parameters are those of <code>pump</code>.</p>
</html>"));
end A4VSGSignals;
