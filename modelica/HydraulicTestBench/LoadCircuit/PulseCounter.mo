within HydraulicTestBench.LoadCircuit;
model PulseCounter "Speed from the time between pulses, as the thesis' simulation counts them"
  extends Icons.Component;
  parameter Integer pulses(min=1) = 10 "Pulses per revolution";
  parameter Types.Percent resolution(min=1e-6) = 0.1 "Commands below this leave the sign as it was"
    annotation(Dialog(tab="Numerics"));
  Interfaces.Flange_a flange "Shaft"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.RealInput direction(unit="%") "Command whose sign is taken for that of the speed"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  Interfaces.RealOutput omegaS(unit="rad/s") "Speed as measured"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  final parameter Types.Angle pitch = 2*Constants.pi/pulses "Angle between pulses";
  Types.Angle theta "Position of the coupling";
  Types.Angle sum5 "Rotation since the last pulse";
  Types.Angle absMe "Its absolute value";
  Types.AngularVelocity contOmega "True speed";
  Real Timer(unit="s") "Time since the last pulse";
  discrete Types.Angle EventTheta(start=0, fixed=true) "Position at the last pulse, before it at the start";
  discrete Types.AngularVelocity EventOmega(start=0, fixed=true) "True speed at the last pulse";
  discrete Real EventTimer(unit="s", start=0, fixed=true) "Time of the last pulse";
  discrete Types.AngularVelocity discOmega(start=0, fixed=true) "Mean speed between the last two pulses, unsigned";
  Boolean backward(start=false, fixed=true) "Whether the command, when last beyond its resolution, was negative";
  Integer count(start=0, fixed=true) "Pulses so far";
equation
  theta = flange.phi;
  contOmega = der(flange.phi);
  sum5 = theta - EventTheta;
  absMe = abs(sum5);
  Timer = time - EventTimer;
  when {initial(), theta > pre(EventTheta) + pitch, theta < pre(EventTheta) - pitch} then
    EventTheta = theta;
  end when;
  when {theta > pre(EventTheta) + pitch, theta < pre(EventTheta) - pitch} then
    EventOmega = contOmega;
    EventTimer = time;
    discOmega = pitch/(time - pre(EventTimer));
    count = pre(count) + 1;
  end when;
  // No when: one whose condition holds from the start never fires (Modelica Language Specification, Section 8.6).
  backward = direction < -resolution or pre(backward) and not direction > resolution;
  omegaS = if pre(backward) then -discOmega else discOmega;
  flange.tau = 0;
  annotation(Documentation(info="<html>
<p>A pulse comes whenever the shaft has turned by 2&pi;/10 since the last one, either way. The speed is that angle over
the time it took, with the sign of the pump's command, and stays until the next pulse: at standstill, and for up to two
pitches after a reversal, it says nothing. <code>Mechanics.PulseSensor</code> counts the teeth themselves.</p>
<p>The sign of Eq. 5.1 is held while the command is within its resolution: a controller that uses the measured speed
gives a command that depends on that sign, and about zero no sign would be the right one. Until the command first leaves
its resolution the sign is +1.</p>
<p><b>Source:</b> thesis Eq. 5.1, Table 14, whose names the variables have. Its Time is the simulation's time. Its Timer
is the running time since the last pulse.</p>
<p><b>Valid:</b> up to the sensor's 800 pulses per second (Appendix D.5).</p>
<p><b>Leaves out:</b> where the teeth stand: the first pulse comes 36 degrees from the start.</p>
</html>"));
end PulseCounter;
