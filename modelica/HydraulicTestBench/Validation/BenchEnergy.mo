within HydraulicTestBench.Validation;
model BenchEnergy "Energy balance of both circuits and the shaft of the test bench"
  extends PartialBenchEnergy;
equation
  bench.omegaS_ref = (1 - exp(-time/2))*(25*sin(2*Constants.pi*0.1*time) + 10*sin(2*Constants.pi*0.17*time + 1)
    + 5*sin(2*Constants.pi*0.31*time));
  bench.pL_ref = 40e5*(1 - exp(-time/2));
  annotation(
    experiment(StartTime=0, StopTime=60, Interval=0.01, Tolerance=1e-7),
    Documentation(info="<html>
<p>In each circuit and at the shaft the error stays within 0.1 percent of the work the motors pass on, over 60 s of
<code>Examples.HeaveReference</code>.</p>
<p><b>Source:</b> first law of thermodynamics.</p>
</html>"));
end BenchEnergy;
