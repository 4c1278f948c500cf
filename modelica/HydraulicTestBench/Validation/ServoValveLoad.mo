within HydraulicTestBench.Validation;
model ServoValveLoad "Step of the servo valve over a load pressure, against Eq. 5.2"
  extends Icons.Example;
  Hydraulics.Tank supply(p=310e5) "Supply"
    annotation(Placement(transformation(extent={{-80, -80}, {-60, -60}})));
  Hydraulics.Tank tank "Tank"
    annotation(Placement(transformation(extent={{60, -80}, {80, -60}})));
  Hydraulics.ServoValve valve(rho=875, dp_smooth=1) "Valve"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}})));
  Hydraulics.Tank load_A(p=205e5) "Pressure at port A: half of supply and load pressure"
    annotation(Placement(transformation(extent={{-80, 60}, {-60, 80}})));
  Hydraulics.Tank load_B(p=105e5) "Pressure at port B: half of supply less load pressure"
    annotation(Placement(transformation(extent={{60, 60}, {80, 80}})));
  Hydraulics.FlowSensor meter "Flow to the load"
    annotation(Placement(transformation(extent={{-50, 60}, {-30, 80}})));
  Real u_exact(unit="1") "Closed form of the spool's step";
  Real error(unit="1") = valve.u_sv - u_exact "Spool, difference from the closed form";
  Types.VolumeFlowRate Q_exact = valve.u_sv*valve.K_sv*sqrt((supply.p - (load_A.p - load_B.p))/875) "Eq. 5.2";
  Types.VolumeFlowRate error_Q = meter.Q - Q_exact "Flow, difference from Eq. 5.2";
protected
  final parameter Types.AngularVelocity sigma = valve.zeta_sv*valve.omega_sv "Decay rate";
  final parameter Types.AngularVelocity omega_d = valve.omega_sv*sqrt(1 - valve.zeta_sv^2) "Damped frequency";
equation
  connect(supply.port, valve.port_P);
  connect(tank.port, valve.port_T);
  connect(valve.port_A, meter.port_a);
  connect(meter.port_b, load_A.port);
  connect(valve.port_B, load_B.port);
  valve.u_ref = 0.5;
  u_exact = 0.5*(1 - exp(-sigma*time)*(cos(omega_d*time) + sigma/omega_d*sin(omega_d*time)));
  annotation(
    experiment(StartTime=0, StopTime=0.03, Interval=0.0001, Tolerance=1e-8),
    Documentation(info="<html>
<p>The spool is the textbook's second order step; the flow through both edges at 100 bar of load pressure is that of
Eq. 5.2 at each moment.</p>
<p><b>Source:</b> thesis Eq. 5.2 and 5, Table 4.</p>
</html>"));
end ServoValveLoad;
