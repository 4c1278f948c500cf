within HydraulicTestBench.Controllers;
block SpeedController "Speed by the pump's angle, sampled: PI and feed forward, thesis Eq. 5.33 and 5.35"
  extends Icons.Component;
  constant Data.LoadCircuit bench = Data.LoadCircuit() "Parameters of the bench";
  parameter Types.Duration dt(min=1e-6) = 1e-3 "Sampling time";
  parameter Real K_p(final unit="s", min=0, nominal=1e-7) = bench.K_Ps "Gain, rad per rad/s";
  parameter Types.Duration T_i(min=1e-9) = bench.T_is "Integration time";
  parameter Types.AngularVelocity omega_zero(min=0) = 2 "Measured speed below which the PI part is off";
  parameter Types.Angle largest(min=1e-3) = 15*Constants.pi/180 "Largest swash plate angle";
  parameter Real feed(final unit="s", nominal=1e-3) = bench.Vm_max/(71e-6*1450/60)*largest/(2*Constants.pi)
    "K_s/K_P of Eq. 5.35: angle over speed";
  Interfaces.RealInput reference(unit="rad/s") "Reference"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  Interfaces.RealInput measured(unit="rad/s") "Measured speed"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  Interfaces.RealOutput alphaCMD(unit="%") "Command of the pump's angle"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput pi(unit="rad") "Its PI part"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
protected
  discrete Types.Angle u(start=0, fixed=true) "What the PI part has, also while it is off";
  discrete Types.AngularVelocity e(start=0, fixed=true) "Error at the last sample with the PI part on";
  discrete Real on(unit="1", start=0, fixed=true) "1 while the PI part is on";
  discrete Types.AngularVelocity error(start=0, fixed=true) "Error";
  discrete Types.AngularVelocity before(start=0, fixed=true) "Error of the sample before, or this one at the first";
  discrete Types.Angle ahead(start=0, fixed=true) "Feed forward";
  discrete Types.Angle part(start=0, fixed=true) "PI part that counts";
  discrete Real command(unit="%", start=0, fixed=true) "Command";
equation
  when sample(0, dt) then
    error = reference - measured;
    on = if abs(measured) >= omega_zero then 1 else 0;
    before = if pre(on) > 0.5 then pre(e) else error;
    ahead = feed*reference;
    u = if on > 0.5 then min(max(pre(u) + K_p*(error - before) + K_p/T_i*dt*before, -largest - ahead), largest - ahead)
      else pre(u);
    e = if on > 0.5 then error else pre(e);
    part = on*u;
    command = 100*min(max(part + ahead, -largest), largest)/largest;
  end when;
  alphaCMD = command;
  pi = part;
  annotation(Documentation(info="<html>
<p>&alpha; = PI + K<sub>s</sub>/K<sub>P</sub> &omega;<sub>ref</sub>. Near standstill, where the pulses say nothing, the
PI part gives zero and keeps what it had for later. The angle's limit goes round the sum of both parts.</p>
<p><b>Source:</b> thesis Eq. 5.33 to 5.35, Table 6.1 (manually tuned), Table 12. Its threshold is not published.</p>
<p><b>Valid:</b> sampling much faster than the shaft's resonance of 8 Hz.</p>
<p><b>Leaves out:</b> the time its calculation takes.</p>
</html>"));
end SpeedController;
