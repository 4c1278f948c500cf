within HydraulicTestBench.Mechanics;
model PulseSensor "Speed from the time between the pulses of an inductive sensor, thesis Eq. 5.1"
  extends Icons.Component;
  parameter Integer pulses(min=1) = 10 "Pulses per revolution";
  Interfaces.Flange_a flange "Shaft"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.RealInput direction "Its sign is taken for that of the speed"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  Interfaces.RealOutput w(unit="rad/s") "Speed as measured"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  Real teeth(unit="1", nominal=10) "Angle, counted in teeth: metal from each whole number to the next half";
  discrete Real ahead(start=0, fixed=true) "Whole number at which metal begins for forward motion";
  discrete Real behind(start=-0.5, fixed=true) "Half number at which metal begins for backward motion";
  Boolean forward "Whether an edge has come in forward motion";
  Boolean backward "Whether an edge has come in backward motion";
  discrete Real t_pulse(unit="s", start=0, fixed=true) "Time of the last rising edge";
  discrete Types.AngularVelocity speed(start=0, fixed=true) "Mean speed between the last two rising edges";
  Integer count(start=0, fixed=true) "Rising edges so far";
equation
  teeth = pulses*flange.phi/(2*Constants.pi);
  forward = teeth > pre(ahead);
  backward = teeth < pre(behind);
  // Edges are thresholds that move on once passed: none is lost in a long step of the solver. The first ones lie on
  // either side of where the shaft starts: one that is passed already would never be passed again.
  when {initial(), forward, teeth < pre(ahead) - 1} then
    ahead = if initial() then ceil(teeth) else if forward then pre(ahead) + 1 else pre(ahead) - 1;
  end when;
  when {initial(), backward, teeth > pre(behind) + 1} then
    behind = if initial() then floor(teeth + 0.5) - 0.5 else if backward then pre(behind) - 1 else pre(behind) + 1;
  end when;
  when {forward, backward} then
    t_pulse = time;
    count = pre(count) + 1;
    speed = if pre(count) > 0 then 2*Constants.pi/(pulses*(time - pre(t_pulse))) else 0;
  end when;
  w = if direction < 0 then -speed else speed;
  flange.tau = 0;
  annotation(Documentation(info="<html>
<p>Metal stands in front of the sensor where sin(n&phi;) &gt; 0. Each time it comes there, from either
side, the measured speed becomes 2&pi;/(n &Delta;T), with &Delta;T the time since the time before, and stays until the
next one. One sensor cannot see the direction: the sign of the command stands for it.</p>
<p><b>Source:</b> thesis Eq. 5.1, Fig. 5.4.</p>
<p><b>Valid:</b> up to the sensor's 800 pulses per second (Appendix D.5), about 500 rad/s with ten pulses.</p>
<p><b>Leaves out:</b> unequal teeth, resolution of the timer. At standstill no edge comes, and the last speed
stays; after a reversal the first interval says nothing of the speed. Both are the sensor's, not the model's.</p>
</html>"));
end PulseSensor;
