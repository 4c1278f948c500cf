within HydraulicTestBench.Examples;
model ActiveHeave "Crane in a swell, its pump fed forward, beside one that does not compensate"
  extends Icons.Example;
  constant Data.Crane crane = Data.Crane() "Numbers of the crane";
  Crane.HydraulicCompensation active "With its pump following the vessel"
    annotation(Placement(transformation(extent={{-60, -20}, {-20, 20}})));
  Crane.IdealCompensation passive(gain=0) "Without"
    annotation(Placement(transformation(extent={{20, -20}, {60, 20}})));
  Interfaces.RealOutput z_v(unit="m") "Heave of the vessel"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput z_active(unit="m") "Height of the payload that is compensated"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  Interfaces.RealOutput z_passive(unit="m") "Height of the payload that is not"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
  Types.Velocity z_v_t "Velocity of the vessel";
  Types.Acceleration z_v_tt "Its rate";
protected
  parameter Real feed(final unit="s/m") = 100*60e-6/(71e-6*1450/60)/(2*Constants.pi*crane.r_d)
    "Percent of the pump's angle over velocity, Eq. 5.35 and 5.50";
equation
  z_v_t = (1 - exp(-time/2))*(0.5*cos(0.63*time) + 0.2*cos(1.07*time + 1) + 0.1*cos(1.95*time + 2));
  z_v_tt = exp(-time/2)/2*(0.5*cos(0.63*time) + 0.2*cos(1.07*time + 1) + 0.1*cos(1.95*time + 2))
    - (1 - exp(-time/2))*(0.315*sin(0.63*time) + 0.214*sin(1.07*time + 1) + 0.195*sin(1.95*time + 2));
  active.z_v_t = z_v_t;
  passive.z_v_t = z_v_t;
  z_v = active.z_v;
  z_active = active.z_PL;
  z_passive = passive.z_PL;
  active.alphaCMD = -feed*z_v_t;
  active.alphaCMD_t = -feed*z_v_tt;
  annotation(
    experiment(StartTime=0, StopTime=60, Interval=0.01, Tolerance=1e-7),
    Documentation(info="<html>
<p>Plot <code>z_v</code>, <code>z_active</code> and <code>z_passive</code>: the payload of the first keeps its height
but for the lag of the swash plate and what the pump's angle drifts by; the second goes with the vessel.</p>
<p><b>Source:</b> thesis Section 5.7, Fig. 5.15 and 5.16; three waves stand for its sea, which was not published.</p>
</html>"));
end ActiveHeave;
