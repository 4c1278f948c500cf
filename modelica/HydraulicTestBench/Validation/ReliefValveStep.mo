within HydraulicTestBench.Validation;
model ReliefValveStep "Opening of a relief valve: its poppet's step, and its pressure at constant flow"
  extends Icons.Example;
  Hydraulics.Tank source(p=120e5) "Pressure that opens the valve by 40 percent"
    annotation(Placement(transformation(extent={{-80, 40}, {-60, 60}})));
  Hydraulics.ReliefValve alone(p_set=100e5, dp_open=50e5, K_max=5e-6, rho=875, T_open=10e-3, zeta=0.6)
    "Valve at constant pressure"
    annotation(Placement(transformation(extent={{-20, 40}, {0, 60}})));
  Hydraulics.FlowSource pump(q=3e-4) "Constant flow"
    annotation(Placement(transformation(extent={{-80, -40}, {-60, -20}})));
  Hydraulics.Volume volume(V=1e-3, beta=1.4e9) "Volume"
    annotation(Placement(transformation(extent={{-50, -60}, {-30, -40}})));
  Hydraulics.ReliefValve valve(p_set=100e5, dp_open=50e5, K_max=5e-6, rho=875, T_open=10e-3, zeta=0.6)
    "Valve that limits the pressure"
    annotation(Placement(transformation(extent={{-20, -60}, {0, -40}})));
  Hydraulics.Tank tank "Tank"
    annotation(Placement(transformation(extent={{60, -20}, {80, 0}})));
  Real opening_exact(unit="1") "Closed form of the poppet's step";
  Real error(unit="1") = alone.opening - opening_exact "Difference from the closed form";
  Types.VolumeFlowRate q_exact = (valve.dp - 100e5)/50e5*5e-6*sqrt(2/875*max(valve.dp, 0)) "Flow at rest";
  Types.VolumeFlowRate error_q = pump.q - q_exact "Constant flow, difference from the closed form at rest";
protected
  final parameter Types.AngularVelocity sigma = alone.zeta*alone.omega_n "Decay rate";
  final parameter Types.AngularVelocity omega_d = alone.omega_n*sqrt(1 - alone.zeta^2) "Damped frequency";
equation
  connect(source.port, alone.port_a);
  connect(alone.port_b, tank.port);
  connect(pump.port, volume.port_a);
  connect(volume.port_b, valve.port_a);
  connect(valve.port_b, tank.port);
  opening_exact = 0.4*(1 - exp(-sigma*time)*(cos(omega_d*time) + sigma/omega_d*sin(omega_d*time)));
  annotation(
    experiment(StartTime=0, StopTime=0.3, Interval=0.0002, Tolerance=1e-8),
    Documentation(info="<html>
<p>Between its stops the poppet is an oscillator; in the end the pressure is the one at which the valve lets all flow
pass.</p>
<p><b>Source:</b> the equations of <code>ReliefValve</code>, solved by hand.</p>
</html>"));
end ReliefValveStep;
