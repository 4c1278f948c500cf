within HydraulicTestBench.Examples;
model HeaveReference "Test bench that follows a speed as of heave compensation, under constant load"
  extends Icons.Example;
  LoadCircuit.TestBench bench "Test bench"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}})));
  Types.AngularVelocity swell "Three waves";
equation
  swell = 25*sin(2*Constants.pi*0.1*time) + 10*sin(2*Constants.pi*0.17*time + 1) + 5*sin(2*Constants.pi*0.31*time);
  bench.omegaS_ref = (1 - exp(-time/2))*swell;
  bench.pL_ref = 40e5*(1 - exp(-time/2));
  annotation(
    experiment(StartTime=0, StopTime=60, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>Plot <code>bench.contOmega</code>, <code>bench.omegaS</code> and <code>bench.omegaS_ref</code>, then the
pressures. The
shaft follows at speed; where it turns round, stiction holds it, the pulses say nothing, and it slips on.</p>
<p><b>Source:</b> thesis Section 6.3, Fig. 6.4 to 6.6, whose reference was not published: three sines of the period of
waves stand for it.</p>
</html>"));
end HeaveReference;
