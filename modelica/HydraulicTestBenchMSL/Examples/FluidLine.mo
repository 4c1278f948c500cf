within HydraulicTestBenchMSL.Examples;
model FluidLine "Orifice of this library between boundaries of Modelica.Fluid"
  extends Modelica.Icons.Example;
  replaceable package Medium = Modelica.Media.Water.ConstantPropertyLiquidWater "Medium";
  inner Modelica.Fluid.System system "Defaults of Modelica.Fluid";
  Modelica.Fluid.Sources.FixedBoundary high(redeclare package Medium = Medium, p=11e5, nPorts=1) "High pressure";
  Modelica.Fluid.Sources.FixedBoundary low(redeclare package Medium = Medium, p=1e5, nPorts=1) "Low pressure";
  Adapters.FluidAdapter into(redeclare package Medium = Medium, rho=995.586) "Into this library";
  Adapters.FluidAdapter out(redeclare package Medium = Medium, rho=995.586) "Out of it";
  HydraulicTestBench.Hydraulics.Orifice orifice(K=1e-6, rho=995.586) "Orifice";
equation
  connect(high.ports[1], into.fluidPort);
  connect(into.port, orifice.port_a);
  connect(orifice.port_b, out.port);
  connect(out.fluidPort, low.ports[1]);
  annotation(
    experiment(StartTime=0, StopTime=1, Interval=0.1, Tolerance=1e-6),
    Documentation(info="<html>
<p>The mass flow is K &radic;(2&rho;&Delta;p), and nothing is lost on the way.</p>
<p><b>Source:</b> thesis Eq. 3.6.</p>
</html>"));
end FluidLine;
