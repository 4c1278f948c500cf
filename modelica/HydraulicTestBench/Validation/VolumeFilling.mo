within HydraulicTestBench.Validation;
model VolumeFilling "Constant flow into three closed volumes with different oils"
  extends Icons.Example;
  Hydraulics.FlowSource source1(q=1e-5) "Flow"
    annotation(Placement(transformation(extent={{-80, 60}, {-60, 80}})));
  Hydraulics.FlowSource source2(q=1e-5) "Flow"
    annotation(Placement(transformation(extent={{-80, 0}, {-60, 20}})));
  Hydraulics.FlowSource source3(q=1e-5) "Flow"
    annotation(Placement(transformation(extent={{-80, -60}, {-60, -40}})));
  Hydraulics.Volume plain(V=1e-3, beta=1.4e9) "Constant stiffness"
    annotation(Placement(transformation(extent={{0, 60}, {20, 80}})));
  Hydraulics.Volume rising(V=1e-3, beta=1.4e9, redeclare Hydraulics.Fluids.RisingStiffness fluid(beta_p=12))
    "Stiffness that rises"
    annotation(Placement(transformation(extent={{0, 0}, {20, 20}})));
  Hydraulics.Volume airy(V=1e-3, beta=1.4e9, redeclare Hydraulics.Fluids.EntrainedAir fluid(eps=0.01)) "Oil with air"
    annotation(Placement(transformation(extent={{0, -60}, {20, -40}})));
  Real pumped(unit="1") = source1.q*time/1e-3 "Volume pumped in, over the volume";
  Real error(unit="1") = plain.p/1.4e9 - pumped "Relative volume: constant stiffness, from the closed form";
  Real error_rising(unit="1") = log(1 + 12*rising.p/1.4e9)/12 - pumped "Rising stiffness, from the closed form";
  Real error_airy(unit="1") = airy.p/1.4e9 + 0.01*(1 - (1.013e5/(airy.p + 1.013e5))^(1/1.4)) - pumped
    "Oil with air, from the closed form";
equation
  connect(source1.port, plain.port_a);
  connect(source2.port, rising.port_a);
  connect(source3.port, airy.port_a);
  annotation(
    experiment(StartTime=0, StopTime=2, Interval=0.01, Tolerance=1e-8),
    Documentation(info="<html>
<p>Two percent of the volume are pumped in. That much is compressed: p/&beta; of plain oil, ln(1 +
&beta;<sub>p</sub>p/&beta;)/&beta;<sub>p</sub> where the stiffness rises, and p/&beta; + &epsilon;(1 -
(p<sub>0</sub>/p<sub>abs</sub>)<sup>1/n</sup>) with air.</p>
<p><b>Source:</b> thesis Eq. 3.4, integrated over the pressure by hand.</p>
</html>"));
end VolumeFilling;
