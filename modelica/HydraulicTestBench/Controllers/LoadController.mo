within HydraulicTestBench.Controllers;
block LoadController "Load pressure by the servo valve, sampled: PI and feed forward, thesis Eq. 5.33 and 5.37"
  extends Icons.Component;
  constant Data.LoadCircuit bench = Data.LoadCircuit() "Parameters of the bench";
  parameter Types.Duration dt(min=1e-6) = 1e-3 "Sampling time";
  parameter Real K_p(final unit="1/Pa", min=0, nominal=1e-9) = bench.K_PL "Gain";
  parameter Types.Duration T_i(min=1e-9) = bench.T_iL "Integration time";
  parameter Real feed(final unit="s/rad", nominal=1e-3) = bench.Vm_max/(2*Constants.pi)/bench.K_qu
    "K_L/K_qu of Eq. 5.37: opening over speed";
  Interfaces.RealInput reference(unit="Pa") "Reference"
    annotation(Placement(transformation(extent={{-140, 60}, {-100, 100}})));
  Interfaces.RealInput measured(unit="Pa") "Pressure across the load motor"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealInput speed(unit="rad/s") "Speed whose flow is fed forward"
    annotation(Placement(transformation(extent={{-140, -100}, {-100, -60}})));
  Interfaces.RealOutput u_ref(unit="1") "Command of the servo valve, within -1 ... 1"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput pi(unit="1") "Its PI part"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
protected
  discrete Real u(unit="1", start=0, fixed=true) "PI part";
  discrete Types.Pressure error(start=0, fixed=true) "Error";
  discrete Real begun(unit="1", start=0, fixed=true) "1 after the first sample";
  discrete Types.Pressure before(start=0, fixed=true) "Error of the sample before, or this one at the first";
  discrete Real ahead(unit="1", start=0, fixed=true) "Feed forward";
  discrete Real command(unit="1", start=0, fixed=true) "Command";
equation
  when sample(0, dt) then
    error = reference - measured;
    begun = 1;
    before = if pre(begun) > 0.5 then pre(error) else error;
    ahead = -feed*speed;
    u = min(max(pre(u) + K_p*(error - before) + K_p/T_i*dt*before, -1 - ahead), 1 - ahead);
    command = min(max(u + ahead, -1), 1);
  end when;
  u_ref = command;
  pi = u;
  annotation(Documentation(info="<html>
<p>u = PI - K<sub>L</sub>/K<sub>qu</sub> &omega;. The valve's limit goes round the sum of both parts.</p>
<p><b>Source:</b> thesis Eq. 5.33, 5.36, 5.37, Table 6.1 (manually tuned), Table 13.</p>
<p><b>Valid:</b> sampling much faster than the servo valve.</p>
<p><b>Leaves out:</b> the time its calculation takes.</p>
</html>"));
end LoadController;
