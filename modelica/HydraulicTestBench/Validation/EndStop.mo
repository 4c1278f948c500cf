within HydraulicTestBench.Validation;
model EndStop "Piston pressed against its end stop"
  extends Icons.Example;
  Pump.ControlPiston piston(
    A_p=401.33e-6, V_0=0.0607e-3, m_eff=62.384, k=0, b=13.422e3, xpMAX=1e-3, xpMIN=-1e-3) "Piston"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Hydraulics.Tank pressure(p=170e5) "Pressure in chamber 1"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
  Hydraulics.Tank tank "No pressure in chamber 2"
    annotation(Placement(transformation(extent={{40, 20}, {80, 60}})));
  Types.Force error = piston.f_stop + pressure.p*piston.A_p "Difference of the forces, zero at rest";
  Types.Length depth = piston.x - piston.xpMAX "How far the stop gives way";
equation
  connect(pressure.port, piston.port_1);
  connect(tank.port, piston.port_2);
  piston.f = 0;
  annotation(
    experiment(StartTime=0, StopTime=0.1, Interval=0.0001, Tolerance=1e-8),
    Documentation(info="<html>
<p>Full supply pressure on one side. At rest the stop carries all of it, h k<sub>stop</sub> d = A<sub>p</sub>p with h of
<code>Functions.endStopForce</code>, at a depth below 0.02 mm.</p>
<p><b>Source:</b> balance of forces, thesis Eq. 3.9.</p>
</html>"));
end EndStop;
