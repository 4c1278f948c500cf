within HydraulicTestBench.Validation;
model WireDrop "Mass that falls into a slack wire from a drum, and swings"
  extends Icons.Example;
  Mechanics.Inertia spool(J=1e6) "Drum that hardly yields"
    annotation(Placement(transformation(extent={{-80, -20}, {-60, 0}})));
  Mechanics.Drum drum(r_d=0.2) "Drum"
    annotation(Placement(transformation(extent={{-50, -20}, {-30, 0}})));
  Mechanics.Wire wire(k_w=1e5, l_0=10) "Wire, slack by 0.2 m at the start"
    annotation(Placement(transformation(extent={{-10, -20}, {10, 0}})));
  Mechanics.Mass load(m=500, s_start=-9.8) "Mass"
    annotation(Placement(transformation(extent={{30, -20}, {50, 0}})));
  Types.Length s_exact "Closed form, until the wire is slack again";
  Types.Length error = load.s - s_exact "Difference from the closed form";
protected
  final parameter Real t_taut(final unit="s") = sqrt(2*0.2/9.81) "When the wire begins to pull";
  final parameter Types.Velocity v_taut = -9.81*t_taut "Velocity then";
  final parameter Types.AngularVelocity omega = sqrt(wire.k_w/load.m) "Frequency on the wire";
  final parameter Types.Length s_rest = -10 - load.m*9.81/wire.k_w "Where it would hang at rest";
equation
  connect(spool.flange_b, drum.shaft);
  connect(drum.wire, wire.flange_a);
  connect(wire.flange_b, load.flange_a);
  s_exact = noEvent(if time < t_taut then -9.8 - 9.81/2*time^2
    else s_rest + (-10 - s_rest)*cos(omega*(time - t_taut)) + v_taut/omega*sin(omega*(time - t_taut)));
  annotation(
    experiment(StartTime=0, StopTime=0.45, Interval=0.001, Tolerance=1e-8),
    Documentation(info="<html>
<p>Free fall, then half a swing on the spring; the smooth beginning of the wire's pull and the drum's inertia move the
result by some micrometres.</p>
<p><b>Source:</b> textbook, piece by piece.</p>
</html>"));
end WireDrop;
