within HydraulicTestBenchMSL.Examples;
model SpeedControl "Test bench with a controller of the standard library's blocks"
  extends Modelica.Icons.Example;
  Modelica.Blocks.Sources.Step reference(height=20, startTime=0.5) "Speed wanted";
  Modelica.Blocks.Continuous.PI controller(k=0.02, T=0.1) "Percent of angle over speed";
  Modelica.Blocks.Math.Feedback error "Error of the true speed";
  Modelica.Blocks.Sources.Constant rate(k=0) "Rate of the command: not told";
  Modelica.Blocks.Sources.Constant valve(k=-0.05) "Servo valve";
  HydraulicTestBench.LoadCircuit.OpenTestBench bench(c=2) "Test bench";
equation
  connect(reference.y, error.u1);
  connect(bench.omega, error.u2);
  connect(error.y, controller.u);
  connect(controller.y, bench.alphaCMD);
  connect(rate.y, bench.alphaCMD_t);
  connect(valve.y, bench.u_ref);
  annotation(
    experiment(StartTime=0, StopTime=30, Interval=0.01, Tolerance=1e-7),
    Documentation(info="<html>
<p>The speed comes to its reference without error.</p>
<p><b>Source:</b> thesis Section 5.4, with the true speed in place of the pulses.</p>
</html>"));
end SpeedControl;
