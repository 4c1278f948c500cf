within HydraulicTestBench.Validation;
model OrificesInSeries "Pressure between two orifices in steady state"
  extends Icons.Example;
  Hydraulics.Tank supply(p=170e5) "Constant supply"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Hydraulics.Tank tank "Tank"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
  Hydraulics.Orifice inlet(K=1e-6, rho=875, dp_smooth=1e3) "Inlet"
    annotation(Placement(transformation(extent={{40, 20}, {80, 60}})));
  Hydraulics.Orifice outlet(K=2e-6, rho=875, dp_smooth=1e3) "Outlet"
    annotation(Placement(transformation(extent={{-80, -40}, {-40, 0}})));
  Hydraulics.Chamber chamber(beta=1.4e9) "Chamber between them"
    annotation(Placement(transformation(extent={{-20, -40}, {20, 0}})));
  Types.Pressure p_exact = supply.p*inlet.K^2/(inlet.K^2 + outlet.K^2) "Closed form of the steady state";
  Types.Pressure error = chamber.p - p_exact "Difference from the closed form";
equation
  connect(supply.port, inlet.port_a);
  connect(inlet.port_b, chamber.port);
  connect(chamber.port, outlet.port_a);
  connect(outlet.port_b, tank.port);
  chamber.V = 1e-4;
  chamber.kappa = 0;
  annotation(
    experiment(StartTime=0, StopTime=0.2, Interval=0.001, Tolerance=1e-8),
    Documentation(info="<html>
<p>Equal flow through both gives K<sub>1</sub><sup>2</sup>(p<sub>S</sub> - p) = K<sub>2</sub><sup>2</sup>p: 34 bar.</p>
<p><b>Source:</b> thesis Eq. 3.6. At these pressure differences the smoothing is below 1e-7.</p>
</html>"));
end OrificesInSeries;
