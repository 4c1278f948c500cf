within HydraulicTestBench.Validation;
model CoastDown "Shaft that runs out under Coulomb friction"
  extends Icons.Example;
  Mechanics.Inertia inertia(J=0.1, w(start=50)) "Shaft, released at 50 rad/s"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Mechanics.Friction friction(r=10, omega_0=5, tau_c=2, tau_s=2) "Friction that does not depend on speed"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
  Types.AngularVelocity w_exact "Closed form";
  Types.AngularVelocity error = inertia.w - w_exact "Difference from the closed form";
protected
  final parameter Real rate(final unit="1/s") = friction.r*friction.tau_c/inertia.J "Rate of the last creep";
equation
  connect(inertia.flange_b, friction.flange);
  // asinh(sinh(500) exp(-rate*time))/r, with sinh(500) exp(-z) = exp(500 - z)/2 to the last digit
  w_exact = noEvent(if rate*time < 480 then (500 - rate*time)/friction.r
    else log(0.5*exp(500 - rate*time) + sqrt(0.25*exp(1000 - 2*rate*time) + 1))/friction.r);
  annotation(
    experiment(StartTime=0, StopTime=3, Interval=0.01, Tolerance=1e-8),
    Documentation(info="<html>
<p>With &tau;<sub>s</sub> = &tau;<sub>c</sub> the law is J d&omega;/dt = -&tau;<sub>c</sub> tanh(r&omega;), and
sinh(r&omega;) decays exponentially: a straight line to standstill at 2.5 s, then a short creep.</p>
<p><b>Source:</b> thesis Eq. 5.38, 5.40, integrated by hand.</p>
</html>"));
end CoastDown;
