within HydraulicTestBench.Pump;
model PadeDeadTime "Dead time as a Pade approximation of order 3"
  extends Interfaces.PartialDeadTime;
  constant Types.Duration tau_min = 0.1e-3 "Shorter dead times are held at this one";
  final parameter Types.Duration T = max(tau, tau_min) "Dead time in force";
  Real z1(unit="1", nominal=1, start=0, fixed=true, stateSelect=StateSelect.always) "First state; equals s at rest";
  Real z2(unit="1", nominal=1, start=0, fixed=true, stateSelect=StateSelect.always) "Second state, T der(z1)";
  Real z3(unit="1", nominal=1, start=0, fixed=true, stateSelect=StateSelect.always) "Third state, T der(z2)";
equation
  der(z1) = z2/T;
  der(z2) = z3/T;
  der(z3) = (120*(s - z1) - 60*z2 - 12*z3)/T;
  y = 2*z1 + z3/5 - s;
  annotation(Documentation(info="<html>
<p>e<sup>-Ts</sup> &asymp; (120 - 60Ts + 12(Ts)<sup>2</sup> - (Ts)<sup>3</sup>)/(120 + 60Ts + 12(Ts)<sup>2</sup> +
(Ts)<sup>3</sup>), as a chain of three states. The model stays a set of ordinary differential equations that any solver
and any importing tool takes. At the start the past is zero: nothing was commanded.</p>
<p><b>Source:</b> thesis Eq. 3.20, e<sup>-&tau;s</sup>; Pade table.</p>
<p><b>Valid:</b> the gain is exactly 1 at all frequencies; the phase error is about (&omega;T)<sup>7</sup>/100800 rad,
below 1e-5 degrees at 20 Hz and 4 ms, and reaches 1 degree at &omega;T = 2.95 (120 Hz at 4 ms). Below tau = 0.1 ms the
dead time is held there, which keeps the poles (about 4.6/T) in reach of an explicit solver.</p>
<p><b>Leaves out:</b> that nothing at all comes out before tau: after a step of s the output starts with a swing of the
opposite sign. <code>TransportDelay</code> is the exact alternative.</p>
</html>"));
end PadeDeadTime;
