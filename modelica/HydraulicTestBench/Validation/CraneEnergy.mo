within HydraulicTestBench.Validation;
model CraneEnergy "Energy balance of the test bench while it acts a minute of crane operation"
  extends PartialBenchEnergy;
  Crane.IdealCompensation crane(gain=0.9, Vm_max=bench.Vm_max) "Crane in a swell; a tenth is left to move its load"
    annotation(Placement(transformation(extent={{-80, -20}, {-40, 20}})));
equation
  crane.z_v_t = (1 - exp(-time/2))*(0.5*cos(0.63*time) + 0.2*cos(1.07*time + 1) + 0.1*cos(1.95*time + 2));
  connect(crane.omegaS_ref, bench.omegaS_ref);
  connect(crane.pL_ref, bench.pL_ref);
  annotation(
    experiment(StartTime=0, StopTime=60, Interval=0.01, Tolerance=1e-7),
    Documentation(info="<html>
<p>The whole rig at the work it is built for: the crane's speed and load pressure are the references, the controllers
follow them with pump and servo valve. In each circuit and at the shaft the error stays within 0.1 percent of the work
the motors pass on.</p>
<p><b>Source:</b> first law of thermodynamics; references of thesis Eq. 5.50 and 5.51, the swell that of
<code>Examples.ActiveHeave</code>.</p>
</html>"));
end CraneEnergy;
