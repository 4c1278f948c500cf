within HydraulicTestBench.Validation;
model LaminarFilling "Volume filled from constant pressure through a laminar resistance"
  extends Icons.Example;
  Hydraulics.Tank supply(p=100e5) "Supply"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Hydraulics.FlowSensor meter "Flow meter"
    annotation(Placement(transformation(extent={{-30, 20}, {-10, 60}})));
  Hydraulics.LaminarResistance resistance(G=1e-12) "Resistance"
    annotation(Placement(transformation(extent={{0, 20}, {40, 60}})));
  Hydraulics.Volume volume(V=1e-3, beta=1e9) "Volume"
    annotation(Placement(transformation(extent={{60, 20}, {100, 60}})));
  Hydraulics.PressureSensor gauge "Pressure gauge"
    annotation(Placement(transformation(extent={{60, -40}, {100, 0}})));
  Types.Pressure p_exact = 100e5*(1 - exp(-time)) "Closed form";
  Types.Pressure error = gauge.p - p_exact "Difference from the closed form";
  Types.VolumeFlowRate error_Q = meter.Q - 1e-5*exp(-time) "Flow, difference from the closed form";
equation
  connect(supply.port, meter.port_a);
  connect(meter.port_b, resistance.port_a);
  connect(resistance.port_b, volume.port_a);
  connect(volume.port_b, gauge.port);
  annotation(
    experiment(StartTime=0, StopTime=5, Interval=0.05, Tolerance=1e-8),
    Documentation(info="<html>
<p>An exponential with the time constant V/(&beta;G) = 1 s, read by the ideal sensors.</p>
<p><b>Source:</b> thesis Eq. 3.4 with Q = G &Delta;p, solved by hand.</p>
</html>"));
end LaminarFilling;
