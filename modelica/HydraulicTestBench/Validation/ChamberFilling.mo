within HydraulicTestBench.Validation;
model ChamberFilling "Constant flow into a closed chamber"
  extends Icons.Example;
  Hydraulics.FlowSource source(q=1e-6) "Flow"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Hydraulics.Chamber chamber(beta=1.4e9, p_start=0) "Chamber"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
  Types.Pressure p_exact = chamber.beta*source.q*time/1e-3 "Closed form";
  Types.Pressure error = chamber.p - p_exact "Difference from the closed form";
equation
  connect(source.port, chamber.port);
  chamber.V = 1e-3;
  chamber.kappa = 0;
  annotation(
    experiment(StartTime=0, StopTime=1, Interval=0.01, Tolerance=1e-8),
    Documentation(info="<html>
<p>The pressure rises by &beta;Qt/V: 14 bar in one second.</p>
<p><b>Source:</b> thesis Eq. 3.4 at rest. Floor of the volume: a share of 1e-10 here.</p>
</html>"));
end ChamberFilling;
