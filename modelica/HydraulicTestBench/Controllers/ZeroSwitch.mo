within HydraulicTestBench.Controllers;
block ZeroSwitch "Lets a signal through unless a speed is near zero"
  extends Icons.Component;
  parameter Types.Duration dt(min=1e-6) = 1e-3 "Sampling time";
  parameter Types.AngularVelocity threshold(min=0) = 2 "Least speed, either way";
  Interfaces.RealInput u(unit="1") "Input"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  Interfaces.RealInput speed(unit="rad/s") "Measured speed"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  Interfaces.RealOutput y(unit="1") "Input, or zero"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput connected(unit="1") "1 while the input is let through, else 0"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
protected
  discrete Real held(unit="1", start=0, fixed=true) "Output";
  discrete Real through(unit="1", start=0, fixed=true) "Whether it is the input";
equation
  when sample(0, dt) then
    through = if abs(speed) >= threshold then 1 else 0;
    held = through*u;
  end when;
  y = held;
  connected = through;
  annotation(Documentation(info="<html>
<p>Near standstill the time between two pulses says nothing of the speed, and a controller that believes it is better
off. <code>connected</code> is for the <code>active</code> of a PI controller.</p>
<p><b>Source:</b> <code>ZeroSwitch</code> and <code>abs_omegaS</code> of thesis Table 12. Its threshold is not
published.</p>
<p><b>Leaves out:</b> hysteresis.</p>
</html>"));
end ZeroSwitch;
