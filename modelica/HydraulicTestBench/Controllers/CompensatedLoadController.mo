within HydraulicTestBench.Controllers;
block CompensatedLoadController "Load pressure by the servo valve whose characteristic is turned round, sampled"
  extends Icons.Component;
  constant Data.LoadCircuit bench = Data.LoadCircuit() "Parameters of the bench";
  parameter Types.Duration dt(min=1e-6) = 1e-3 "Sampling time";
  parameter Real K_p(final unit="m3/(s.Pa)", min=0, nominal=1e-12) = bench.K_PL*bench.K_qu "Gain";
  parameter Types.Duration T_i(min=1e-9) = bench.T_iL "Integration time";
  parameter Real motor(final unit="m3/rad", min=0, nominal=1e-5) = bench.Vm_max/(2*Constants.pi)
    "Flow of the load motor over its speed";
  parameter Types.Area valve(min=1e-9) = bench.K_sv "Flow over opening and root of pressure over density";
  parameter Types.Density rho(min=1) = 875 "Density of oil";
  parameter Types.Pressure least(min=1) = 5e5 "Pressure drop below which the valve is taken to have this one";
  parameter Types.Duration smoothing(min=0) = 0.1 "Time constant of the load pressure's lag, 0 = none";
  Interfaces.RealInput reference(unit="Pa") "Reference"
    annotation(Placement(transformation(extent={{-140, 60}, {-100, 100}})));
  Interfaces.RealInput measured(unit="Pa") "Pressure across the load motor"
    annotation(Placement(transformation(extent={{-140, 10}, {-100, 50}})));
  Interfaces.RealInput speed(unit="rad/s") "Speed whose flow is fed forward"
    annotation(Placement(transformation(extent={{-140, -50}, {-100, -10}})));
  Interfaces.RealInput supply(unit="Pa") "Supply pressure of the load circuit"
    annotation(Placement(transformation(extent={{-140, -100}, {-100, -60}})));
  Interfaces.RealOutput u_ref(unit="1") "Command of the servo valve, within -1 ... 1"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput pi(unit="m3/s") "Its PI part"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
protected
  discrete Types.VolumeFlowRate q(start=0, fixed=true) "PI part";
  discrete Types.Pressure error(start=0, fixed=true) "Error";
  discrete Real begun(unit="1", start=0, fixed=true) "1 after the first sample";
  discrete Types.Pressure before(start=0, fixed=true) "Error of the sample before, or this one at the first";
  discrete Types.VolumeFlowRate ahead(start=0, fixed=true) "Feed forward";
  discrete Types.Pressure smooth(start=0, fixed=true) "Load pressure, smoothed";
  discrete Types.VolumeFlowRate upwards(start=1, fixed=true) "Flow of the fully open valve that raises the pressure";
  discrete Types.VolumeFlowRate downwards(start=1, fixed=true) "The same, lowering it";
  discrete Real command(unit="1", start=0, fixed=true) "Command";
equation
  when sample(0, dt) then
    error = reference - measured;
    begun = 1;
    before = if pre(begun) > 0.5 then pre(error) else error;
    ahead = -motor*speed;
    smooth = dt/max(smoothing, dt)*measured + (1 - dt/max(smoothing, dt))*pre(smooth);
    upwards = valve*sqrt(max(supply - smooth, least)/rho);
    downwards = valve*sqrt(max(supply + smooth, least)/rho);
    q = min(max(pre(q) + K_p*(error - before) + K_p/T_i*dt*before, -downwards - ahead), upwards - ahead);
    command = min(max((q + ahead)/(if q + ahead > 0 then upwards else downwards), -1), 1);
  end when;
  u_ref = command;
  pi = q;
  annotation(Documentation(info="<html>
<p>PI and feed forward ask for a flow; the opening is what lets it through at the pressure drop that is there. The
loop's gain does not change with the load, and the motor's flow is fed forward as a flow. The load pressure is
smoothed for it: taken as it is, the valve would no longer damp the shaft by letting through less as the load pressure
rises.</p>
<p><b>Source:</b> thesis Eq. 5.2 solved for the opening; proposed in its Section 6.1. Differs: the smoothing.</p>
<p><b>Valid:</b> as <code>ValveCompensation</code>.</p>
<p><b>Leaves out:</b> overlap of the edges, the time its calculation takes.</p>
</html>"));
end CompensatedLoadController;
